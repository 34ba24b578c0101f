// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "diagram/bottleneck/points_left.hpp"
#include "ph/distances.hpp"

namespace ph::diagram {

/// Pairs bars of one diagram with bars of another, the long ones of the first among them. What was
/// found at one radius is where the search begins at the next.
class OneSidedMatching {
 public:
  /// @param from the longest first. @param to in any order. Both outlive this.
  OneSidedMatching(std::span<const Point> from, std::span<const Point> to,
                   const RunContext& context);

  /// The least radius from `bound` on at which each long bar has a partner near it, if not for
  /// itself. Short bars are not looked at. To be called before `narrow`.
  double lower_bound(double bound);

  /// Narrows down the least radius, from bounds.lower on, at which all bars farther than it from
  /// the diagonal can be paired with bars no farther than it from them. Ends when enough is known,
  /// or when the radius is known to be bounds.value or less.
  /// @param bounds lower: at least what lower_bound gave. @return the bounds of that radius.
  DistanceBounds narrow(const DistanceBounds& bounds, const DistanceLimits& limits);

  /// Finds a matching for a radius that is possible.
  void match_at(double radius) { hall_bound(radius); }
  /// After match_at, by places in `from` and in `to`: the other one, or kNone.
  std::vector<std::uint32_t> partners_of_from() const;
  std::vector<std::uint32_t> partners_of_to() const;

 private:
  using Position = PointTree::Position;
  using Number = std::uint32_t;  // of a candidate

  /// A bar of the first diagram that may have to be paired.
  struct Candidate {
    Point point;
    double to_diagonal;
    std::uint32_t place;
    Position nearest;
  };

  /// Nothing if all long bars can be paired within the radius, as they then are. Else the least
  /// radius, larger than this, at which some of them might: those of a closed tree of alternating
  /// paths have one partner too few between them (Hall).
  std::optional<double> hall_bound(double radius);
  /// Pairs that are too far apart, and those of short bars, are none any more.
  void keep_pairs_within(double radius);
  /// Gives bars that are alone whoever is free. @return those for whom nobody is.
  std::vector<Number> pair_with_free(double radius);
  /// Looks for disjoint alternating paths to free bars, one after the other, each far before wide.
  /// @param roots keeps those that are not paired.
  void search_in_depth(std::vector<Number>& roots, double radius);
  /// Grows disjoint trees of alternating paths from bars that are alone, by breadth. Whoever
  /// reaches a free bar is paired, and its tree grows no more. @param roots keeps those that are
  /// not.
  void grow_trees(std::vector<Number>& roots, double radius);
  /// Makes the pairs on the path from a root to a free bar those that it had not before.
  void pair_along(Number root, Number last, Position free);
  /// After grow_trees in vain: the least radius at which a bar of a tree reaches another one, or
  /// need not be paired.
  double least_way_out();
  /// The least radius at which the pairs that there are would do.
  double cost() const;

  std::span<const Point> from_, to_;
  const RunContext& context_;
  Ticker ticker_;
  std::vector<Candidate> candidates_;  // in the order of what is nearest to them
  std::vector<Position> partner_;      // by number
  std::optional<PointTree> tree_;      // of to_, if there are any
  std::vector<Number> paired_with_;    // by position
  std::optional<PointsLeft> free_, unseen_;
  std::vector<Number> nodes_;         // of the trees that grow_trees has grown
  std::vector<Number> root_of_;       // by number, those of nodes_
  std::vector<Number> reached_from_;  // by position
  std::minstd_rand random_;           // always the same numbers
};

}  // namespace ph::diagram
