// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "libph/src/diagram/bottleneck/points_left.hpp"
#include "ph/distances.hpp"

namespace ph::diagram {

/// Pairs bars of one diagram with bars of another diagram within a radius. Every long bar of the
/// first diagram, that is, every bar farther than the radius from the diagonal, gets a partner. The
/// matching for one radius is the start of the search for the next radius.
class OneSidedMatching {
 public:
  /// @param from the finite bars of the first diagram, longest first. @param to the finite bars of
  /// the second diagram, in any order. Both must outlive this object.
  OneSidedMatching(std::span<const Point> from, std::span<const Point> to,
                   const RunContext& context);

  /// The least radius >= `bound` at which each long bar, considered alone, has a partner within the
  /// radius. Must be called before `narrow`.
  double lower_bound(double bound);

  /// Narrows down the least radius r >= bounds.lower with the following property: all bars farther
  /// than r from the diagonal can be paired with bars at a distance of at most r. Stops when the
  /// accuracy is sufficient, or when r is known to be at most bounds.value or above limits.at_most.
  /// @param bounds bounds.lower must be at least the result of lower_bound.
  /// @return the bounds of r.
  DistanceBounds narrow(const DistanceBounds& bounds, const DistanceLimits& limits);

  /// Finds a matching for a radius at which one exists.
  void match_at(double radius) { hall_bound(radius); }
  /// Must be called after match_at. Returns the partner of each place in `from` and in `to`, or
  /// kNone.
  std::vector<std::uint32_t> partners_of_from() const;
  std::vector<std::uint32_t> partners_of_to() const;

 private:
  using Position = PointTree::Position;
  using Number = std::uint32_t;  // the number of a candidate

  /// A bar of the first diagram that may have to be paired.
  struct Candidate {
    Point point;
    double to_diagonal;
    std::uint32_t place;
    Position nearest;
  };

  /// Tries to pair all long bars within the radius, and returns nothing if this succeeds. Otherwise
  /// returns a larger radius, below which pairing is impossible. The reason is Hall's theorem: when
  /// the trees of alternating paths can no longer grow, their bars have too few possible partners.
  std::optional<double> hall_bound(double radius);
  /// Removes pairs of bars that are too far apart, and pairs of short bars.
  void keep_pairs_within(double radius);
  /// Pairs long bars that have no partner with free bars. @return the long bars that still have no
  /// partner, because no free bar is within the radius.
  std::vector<Number> pair_with_free(double radius);
  /// Looks for disjoint alternating paths to free bars, one after another, depth first.
  /// @param roots bars without a partner; bars that find a partner are removed.
  void search_in_depth(std::vector<Number>& roots, double radius);
  /// Grows disjoint trees of alternating paths from the roots, breadth first. When a tree reaches a
  /// free bar, its root gets a partner and the tree stops growing. @param roots bars without a
  /// partner; bars that find a partner are removed.
  void grow_trees(std::vector<Number>& roots, double radius);
  /// Exchanges the pairs on the path from a root to a free bar.
  void pair_along(Number root, Number last, Position free);
  /// Must be called after grow_trees has failed. Returns the least radius at which a bar of a tree
  /// either reaches a bar outside the trees or need not be paired.
  double least_way_out();
  /// The least radius for which the current pairs would be enough.
  double cost() const;

  std::span<const Point> from_, to_;
  const RunContext& context_;
  Ticker ticker_;
  std::vector<Candidate> candidates_;  // sorted by the positions of their nearest bars
  std::vector<Position> partner_;      // the partner of each candidate, or kNone
  std::optional<PointTree> tree_;      // the tree of to_; absent if it is not needed
  std::vector<Number> paired_with_;    // the candidate paired with each position
  std::optional<PointsLeft> free_, unseen_;
  std::vector<Number> nodes_;         // the nodes of the trees that grow_trees has grown
  std::vector<Number> root_of_;       // for each candidate in nodes_, the root of its tree
  std::vector<Number> reached_from_;  // the candidate from which each position was reached
  std::minstd_rand random_;           // has a fixed seed, which makes results reproducible
};

}  // namespace ph::diagram
