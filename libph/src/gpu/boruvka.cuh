// SPDX-License-Identifier: MIT
#pragma once
#include <thrust/device_vector.h>

#include <memory>
#include <span>

#include "gpu/device_points.cuh"
#include "ph/detail/core/flag_filtration.hpp"
#include "ph/run_context.hpp"

namespace ph::gpu {

/// An edge between two rows, as the order of edges of one length compares them.
PH_DEVICE std::uint64_t ends_of(std::uint32_t a, std::uint32_t b) {
  return a > b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}

/// What a kernel sees of Boruvka.
struct BoruvkaView {
  std::uint32_t* component;  // by position: one of its positions
  Nearest* nearest;          // by position: of the last answer; if that is none or is not foreign
                             // any more, the nearest foreign point comes later
  std::uint64_t* bounds;     // by component: the bits of a length that its best edge has at most
  std::uint64_t* ends;       // by component: of the first among its edges of that length
  std::uint32_t* takes;      // by component: the position that has its best edge
  std::uint32_t* joins;      // by component: the one that it becomes part of

  PH_DEVICE bool knows(std::uint32_t p) const {
    const std::uint32_t q = nearest[p].position;
    return q != kNone && component[q] != component[p];
  }
  /// Whether p may have a better edge than its component knows.
  PH_DEVICE bool is_worth_asking(std::uint32_t p) const {
    if (knows(p)) return false;
    const double bound = of_bits(bounds[component[p]]);
    return nearest[p].position == kNone ? nearest[p].distance < bound
                                        : nearest[p].distance <= bound;
  }
  /// The components of p and q know of the edge between them.
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

/// How the points of a forest are found that are near each other. Positions are an order of its
/// own.
class Search {
 public:
  virtual ~Search() = default;
  virtual std::uint32_t size() const = 0;
  /// By position, on the device: as the caller numbers them.
  virtual const std::uint32_t* rows() const = 0;
  /// Told of the components whenever they have changed.
  virtual void see(const BoruvkaView& v) = 0;
  /// Lowers the bounds of components to the distances of points that follow each other.
  virtual void bound_by_followers(const BoruvkaView& v) = 0;
  /// The nearest foreign points of those asked for, whose components learn of them. Who cannot be
  /// as near as the bound may be left out.
  virtual void ask(Positions& asked, const BoruvkaView& v, const RunContext& context) = 0;
};

/// By boxes, in spaces of 1 to 8 axes. @param x coordinates by row, on the device.
/// @param edges where copies are joined to the first of them, by row. @param box of all points:
/// the least coordinates, then the largest. @return null if there are no two distinct points.
std::unique_ptr<Search> search_by_boxes(const double* x, std::uint32_t size, int axes,
                                        std::span<const double> box, FlagEdge* edges);
/// By all pairs, in spaces of any number of axes.
std::unique_ptr<Search> search_by_pairs(const double* x, std::uint32_t size, int axes,
                                        double limit);

/// Adds the edges of the forest up to the limit.
/// @param edges by row, one of each component that was joined to another; the others keep what
/// they hold.
void find_forest(Search& search, double limit, FlagEdge* edges, const RunContext& context);

}  // namespace ph::gpu
