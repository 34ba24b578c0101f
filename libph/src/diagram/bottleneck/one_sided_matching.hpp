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

/// Pairs bars of one diagram with bars of another, including all long bars of the first. The result
/// for one radius is the start of the search at the next.
class OneSidedMatching {
 public:
  /// @param from longest first. @param to in any order. Both must outlive this object.
  OneSidedMatching(std::span<const Point> from, std::span<const Point> to,
                   const RunContext& context);

  /// The least radius from `bound` on at which each long bar, considered alone, has a partner near
  /// it. Short bars are ignored. Must be called before `narrow`.
  double lower_bound(double bound);

  /// Narrows down the least radius, from bounds.lower on, at which all bars farther than the radius
  /// from the diagonal can be paired with bars within the radius. Stops when the accuracy suffices,
  /// or when the radius is known to be at most bounds.value.
  /// @param bounds lower: at least the result of lower_bound. @return the bounds of that radius.
  DistanceBounds narrow(const DistanceBounds& bounds, const DistanceLimits& limits);

  /// Finds a matching for a radius that is possible.
  void match_at(double radius) { hall_bound(radius); }
  /// After match_at: the partner of each place in `from` and in `to`, or kNone.
  std::vector<std::uint32_t> partners_of_from() const;
  std::vector<std::uint32_t> partners_of_to() const;

 private:
  using Position = PointTree::Position;
  using Number = std::uint32_t;  // number of a candidate

  /// A bar of the first diagram that may have to be paired.
  struct Candidate {
    Point point;
    double to_diagonal;
    std::uint32_t place;
    Position nearest;
  };

  /// Nothing if all long bars can be paired within the radius; they are paired then. Otherwise a
  /// larger radius, the least at which this might change: the bars of a closed tree of alternating
  /// paths have too few partners (Hall).
  std::optional<double> hall_bound(double radius);
  /// Removes pairs that are too far apart, and pairs of short bars.
  void keep_pairs_within(double radius);
  /// Pairs single bars with free bars. @return the bars for which no free bar is near.
  std::vector<Number> pair_with_free(double radius);
  /// Looks for disjoint alternating paths to free bars, one after the other, depth first.
  /// @param roots keeps the bars that are not paired.
  void search_in_depth(std::vector<Number>& roots, double radius);
  /// Grows disjoint trees of alternating paths from single bars, breadth first. A tree that reaches
  /// a free bar is paired and stops growing. @param roots keeps the bars that are not paired.
  void grow_trees(std::vector<Number>& roots, double radius);
  /// Exchanges the pairs on the path from a root to a free bar.
  void pair_along(Number root, Number last, Position free);
  /// After grow_trees failed: the least radius at which a bar of a tree reaches another bar, or
  /// need not be paired.
  double least_way_out();
  /// The least radius for which the present pairs would be enough.
  double cost() const;

  std::span<const Point> from_, to_;
  const RunContext& context_;
  Ticker ticker_;
  std::vector<Candidate> candidates_;  // sorted so that bars with near partners come together
  std::vector<Position> partner_;      // by number
  std::optional<PointTree> tree_;      // of to_, if it has points
  std::vector<Number> paired_with_;    // by position
  std::optional<PointsLeft> free_, unseen_;
  std::vector<Number> nodes_;         // nodes of the trees that grow_trees has grown
  std::vector<Number> root_of_;       // by number, for nodes_
  std::vector<Number> reached_from_;  // by position
  std::minstd_rand random_;           // always the same sequence
};

}  // namespace ph::diagram
