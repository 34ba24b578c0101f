// SPDX-License-Identifier: MIT
#pragma once
#include <thrust/device_vector.h>

#include <memory>
#include <span>

#include "libph/src/gpu/device_points.cuh"
#include "ph/detail/core/flag_filtration.hpp"
#include "ph/run_context.hpp"

namespace ph::gpu {

/// The ends of an edge between two rows as one number, which orders edges of equal length.
PH_DEVICE std::uint64_t ends_of(std::uint32_t a, std::uint32_t b) {
  return a > b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}

/// The data of Boruvka in kernels.
struct BoruvkaView {
  std::uint32_t* component;  // by position: a position that represents its component
  Nearest* nearest;          // by position: the last answer; if there is none or it is in the same
                             // component now, the nearest foreign point is farther
  std::uint64_t* bounds;     // by component: bits of an upper bound for the length of its best edge
  std::uint64_t* ends;       // by component: ends of its first edge of that length
  std::uint32_t* takes;      // by component: the position that has its best edge
  std::uint32_t* joins;      // by component: the component that it becomes part of

  PH_DEVICE bool knows(std::uint32_t p) const {
    const std::uint32_t q = nearest[p].position;
    return q != kNone && component[q] != component[p];
  }
  /// True if p may have a better edge than its component knows.
  PH_DEVICE bool is_worth_asking(std::uint32_t p) const {
    if (knows(p)) return false;
    const double bound = of_bits(bounds[component[p]]);
    return nearest[p].position == kNone ? nearest[p].distance < bound
                                        : nearest[p].distance <= bound;
  }
  /// Tells the components of p and q about the edge between them.
  PH_DEVICE void bound(std::uint32_t p, std::uint32_t q, double d) const {
    lower(bounds[component[p]], bits_of(d));
    lower(bounds[component[q]], bits_of(d));
  }
  PH_DEVICE void answer(std::uint32_t p, const Nearest& found) const {
    nearest[p] = found;
    if (found.position != kNone) lower(bounds[component[p]], bits_of(found.distance));
  }
  PH_DEVICE bool has_best_length(std::uint32_t p) const {
    return knows(p) && bits_of(nearest[p].distance) == bounds[component[p]];
  }
};

using Positions = thrust::device_vector<std::uint32_t>;

/// The way to find points of other components near the points of a forest. Positions are numbered
/// in the search's own order.
class Search {
 public:
  virtual ~Search() = default;
  virtual std::uint32_t size() const = 0;
  /// By position, on the device: the number of the point in the caller's order.
  virtual const std::uint32_t* rows() const = 0;
  /// Called whenever the components have changed.
  virtual void see(const BoruvkaView& v) = 0;
  /// Lowers the bounds of components to the distances of consecutive points.
  virtual void bound_by_followers(const BoruvkaView& v) = 0;
  /// Finds the nearest foreign points of the points `asked`, and tells their components. Points
  /// that cannot be as near as the bound may be skipped.
  virtual void ask(Positions& asked, const BoruvkaView& v, const RunContext& context) = 0;
};

/// Searches by boxes, in spaces of 1 to 8 axes. @param x coordinates by row, on the device.
/// @param edges receives edges that join copies to the first of them, by row. @param box of all
/// points: the smallest coordinates, then the largest. @return null if there are no two distinct
/// points.
std::unique_ptr<Search> search_by_boxes(const double* x, std::uint32_t size, int axes,
                                        std::span<const double> box, FlagEdge* edges);
/// Searches all pairs, in spaces of any number of axes.
std::unique_ptr<Search> search_by_pairs(const double* x, std::uint32_t size, int axes,
                                        double limit);

/// Adds the edges of the forest up to the limit.
/// @param edges by row, one for each component that was joined to another; other entries keep their
/// content.
void find_forest(Search& search, double limit, FlagEdge* edges, const RunContext& context);

}  // namespace ph::gpu
