// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>

#include "ph/detail/core/field.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Receives the pairs of birth and death that `pair_points` finds. Vertices are rows of the points.
class PointPairObserver {
 public:
  using Vertex = std::uint32_t;
  struct Edge {
    double value;
    Vertex larger, smaller;
  };
  PointPairObserver() = default;
  PointPairObserver(const PointPairObserver&) = delete;
  PointPairObserver& operator=(const PointPairObserver&) = delete;
  virtual ~PointPairObserver() = default;

  virtual void on_join(Vertex younger, const Edge& edge) = 0;
  /// Receives a component that is never joined to an older component.
  virtual void on_component(Vertex oldest) = 0;
  /// Receives the death of a class. @param apex the third vertex of the triangle over the edge
  /// `death` that kills the class; 0 if apexes are not wanted.
  virtual void on_death(const Edge& birth, const Edge& death, Vertex apex) = 0;
  virtual void on_essential(const Edge& birth) = 0;
};

struct PointPairRequest {
  double threshold;   ///< length of the longest edge, inclusive
  bool loops = true;  ///< true if H1 is wanted in addition to H0
  bool apexes = true;
};

/// The pairs of positive length in H0 and H1 of the Rips filtration of points with few coordinates.
/// The cells of each pair are the same as with the standard algorithm. Memory is proportional to
/// the number of points. See docs/explanation/engines/beta-skeleton.md.
/// @param points must have 1 to 4 coordinates for which has_plain_coordinates is true.
template <Field K>
void pair_points(PointsView points, const K& field, const PointPairRequest& wanted,
                 PointPairObserver& observer, const RunContext& context);

extern template void pair_points<Z2>(PointsView, const Z2&, const PointPairRequest&,
                                     PointPairObserver&, const RunContext&);
extern template void pair_points<Zp>(PointsView, const Zp&, const PointPairRequest&,
                                     PointPairObserver&, const RunContext&);

/// The largest number of coordinates per point. With more coordinates, spindles rarely contain a
/// point.
inline constexpr Index kMostPointCoordinates = 4;

/// True if all coordinates are zero or have an absolute value between 1e-120 and 1e150. Two
/// different coordinates then differ by at least 1e-137, and the square of a difference neither
/// underflows nor overflows.
bool has_plain_coordinates(PointsView points);

}  // namespace ph
