// SPDX-License-Identifier: MIT
#pragma once
#include <thrust/device_vector.h>

#include <memory>
#include <span>

#include "libph/src/gpu/device_points.cuh"
#include "ph/detail/core/flag_filtration.hpp"
#include "ph/run_context.hpp"

namespace ph::gpu {

/// The rows of the two ends of an edge, packed into one number. Edges of equal length are ordered
/// by this number.
PH_DEVICE std::uint64_t ends_of(std::uint32_t a, std::uint32_t b) {
  return a > b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}

/// The arrays of Boruvka, for use in kernels.
struct BoruvkaView {
  // For each position, the position that represents its component.
  std::uint32_t* component;
  // For each position, the last answer. The answer may have no point, or a point that is now in the
  // same component. In both cases, the nearest foreign point is at least as far away as the
  // distance in the answer.
  Nearest* nearest;
  // For each component, the bits of an upper bound for the length of its best edge.
  std::uint64_t* bounds;
  std::uint64_t* ends;   // for each component, the ends of its best edge (see ends_of)
  std::uint32_t* takes;  // for each component, the position at which its best edge starts
  std::uint32_t* joins;  // for each component, the component that it becomes part of

  PH_DEVICE bool knows(std::uint32_t p) const {
    const std::uint32_t q = nearest[p].position;
    return q != kNone && component[q] != component[p];
  }
  /// True if an edge at p may be better than the best edge that is known for the component of p.
  PH_DEVICE bool is_worth_asking(std::uint32_t p) const {
    if (knows(p)) return false;
    const double bound = of_bits(bounds[component[p]]);
    return nearest[p].position == kNone ? nearest[p].distance < bound
                                        : nearest[p].distance <= bound;
  }
  /// Lowers the bounds of the components of p and q to the length d of the edge between p and q.
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

/// For each point of a forest, finds the nearest point of another component (a *foreign* point).
/// Each kind of search has its own order of the points, and numbers them by their positions in this
/// order.
class Search {
 public:
  virtual ~Search() = default;
  virtual std::uint32_t size() const = 0;
  /// For each position, the row of its point in the caller's order. The array is on the device.
  virtual const std::uint32_t* rows() const = 0;
  /// Must be called whenever the components have changed.
  virtual void see(const BoruvkaView& v) = 0;
  /// Lowers the bounds of components to the distances between consecutive points of different
  /// components.
  virtual void bound_by_followers(const BoruvkaView& v) = 0;
  /// Finds the nearest foreign point of each point in `asked`, and records it as the answer of that
  /// point. Foreign points farther away than the bound of the component may be skipped.
  virtual void ask(Positions& asked, const BoruvkaView& v, const RunContext& context) = 0;
};

/// Makes a search that uses a hierarchy of boxes, for spaces with 1 to 8 axes. @param x the
/// coordinates by row, on the device. @param edges indexed by row; receives an edge from each copy
/// of a point to the first copy. @param box the bounding box of all points: the smallest
/// coordinates, then the largest.
/// @return null unless there are two distinct points.
std::unique_ptr<Search> search_by_boxes(const double* x, std::uint32_t size, int axes,
                                        std::span<const double> box, FlagEdge* edges);
/// Makes a search that compares all pairs of points, for spaces with any number of axes.
std::unique_ptr<Search> search_by_pairs(const double* x, std::uint32_t size, int axes,
                                        double limit);

/// Finds the edges of the forest that are no longer than the limit.
/// @param edges indexed by row; receives one edge for each component that is joined to another. All
/// other entries stay unchanged.
void find_forest(Search& search, double limit, FlagEdge* edges, const RunContext& context);

}  // namespace ph::gpu
