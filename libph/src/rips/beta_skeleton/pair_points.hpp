// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>

#include "ph/detail/core/field.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// What is told of the pairs of points; vertices are rows of the points.
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
  virtual void on_component(Vertex oldest) = 0;  ///< never joined to an older one
  /// @param apex of the triangle over the edge `death` that kills; 0 where apexes are not wanted.
  virtual void on_death(const Edge& birth, const Edge& death, Vertex apex) = 0;
  virtual void on_essential(const Edge& birth) = 0;
};

struct PointPairRequest {
  double threshold;   ///< of edges, inclusive
  bool loops = true;  ///< H1, not only H0
  bool apexes = true;
};

/// The pairs of positive length of H0 and H1 of the Rips filtration of points of the plane or of
/// space, those of the standard algorithm, cell by cell. Memory grows with the points. See
/// docs/explanation/engines/beta-skeleton.md.
/// @param points of 1 to 4 plain coordinates, see has_plain_coordinates.
template <Field K>
void pair_points(PointsView points, const K& field, const PointPairRequest& wanted,
                 PointPairObserver& observer, const RunContext& context);

extern template void pair_points<Z2>(PointsView, const Z2&, const PointPairRequest&,
                                     PointPairObserver&, const RunContext&);
extern template void pair_points<Zp>(PointsView, const Zp&, const PointPairRequest&,
                                     PointPairObserver&, const RunContext&);

/// Of a point. With more of them hardly a spindle has a point.
inline constexpr Index kMostPointCoordinates = 4;

/// Whether all coordinates are zero or of a size from 1e-120 to 1e150. Two of them that differ then
/// differ by 1e-137 at least, so that no square of a difference underflows or overflows.
bool has_plain_coordinates(PointsView points);

}  // namespace ph
