// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ph/detail/diagram/point_tree.hpp"

namespace ph::diagram {

/// Merges two matchings into one matching that covers the long bars of both diagrams. The first
/// matching must cover all long bars of the first diagram, and the second matching must cover all
/// long bars of the second diagram. The pairs of the two matchings form paths and cycles on which
/// the matchings alternate. On each path, one of the two matchings covers all long bars (Mendelsohn
/// and Dulmage).
class JoinedMatchings {
 public:
  using Mates = std::span<const std::uint32_t>;

  /// @param first_of_a, first_of_b the first matching, as the partner of each bar of the first and
  /// of the second diagram, or kNone. @param second_of_a, second_of_b the same for the second
  /// matching.
  JoinedMatchings(Mates first_of_a, Mates first_of_b, Mates second_of_a, Mates second_of_b)
      : mates_{{first_of_a, first_of_b}, {second_of_a, second_of_b}},
        seen_(first_of_a.size() + first_of_b.size()) {}

  /// @return the partner of each bar of the first diagram, or kNone.
  std::vector<std::uint32_t> join() {
    partners_.assign(mates_[0][0].size(), kNone);
    // Paths are followed first. They start at bars that have a partner in only one of the
    // matchings. After that, only cycles are left.
    for (const bool ends : {true, false})
      for (std::size_t side : {0U, 1U})
        for (std::uint32_t i = 0; i < mates_[0][side].size(); ++i) {
          const bool in_first = mate(0, side, i) != kNone, in_second = mate(1, side, i) != kNone;
          if (seen(side, i) || !(in_first || in_second) || (ends && in_first && in_second))
            continue;
          take(side, i, in_first ? 0 : 1);
        }
    return std::move(partners_);
  }

 private:
  std::uint32_t mate(std::size_t matching, std::size_t side, std::uint32_t i) const {
    return mates_[matching][side][i];
  }
  std::vector<bool>::reference seen(std::size_t side, std::uint32_t i) {
    return seen_[side * mates_[0][0].size() + i];
  }
  /// Follows a path from one of its ends, or a cycle, and keeps the pairs of the matching that has
  /// more pairs on it. If both matchings have the same number of pairs, the start decides: the
  /// first matching is kept if the path starts at a bar of the first diagram, otherwise the second
  /// matching.
  void take(std::size_t side, std::uint32_t start, std::size_t matching) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs[2];
    std::size_t at_side = side, at_matching = matching;
    std::uint32_t at = start;
    seen(side, start) = true;
    for (;;) {
      const std::uint32_t next = mate(at_matching, at_side, at);
      if (next == kNone) break;
      pairs[at_matching].emplace_back(at_side == 0 ? at : next, at_side == 0 ? next : at);
      at_side = 1 - at_side;
      if (seen(at_side, next)) break;
      seen(at_side, next) = true;
      at = next;
      at_matching = 1 - at_matching;
    }
    // A path with equal numbers of pairs from the two matchings ends on the side where it began.
    // mutant: bottleneck-pairs
    const std::size_t better =
        pairs[0].size() != pairs[1].size() ? (pairs[0].size() > pairs[1].size() ? 0U : 1U) : side;
    for (const auto& [a, b] : pairs[better]) partners_[a] = b;
  }

  Mates mates_[2][2];
  std::vector<bool> seen_;
  std::vector<std::uint32_t> partners_;
};

}  // namespace ph::diagram
