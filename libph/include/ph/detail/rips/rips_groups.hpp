// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/detail/core/bit_matrix.hpp"
#include "ph/detail/rips/rips_graph.hpp"

namespace ph {

/// The simplices of one longest edge e after the other, as cliques of the link of e: the vertices
/// that edges before e join to both of its ends. Finds those that are in no apparent pair without
/// looking at most of the others; see docs/explanation/engines/cohomology.md.
class RipsGroups {
 public:
  using Key = RipsGraph::Key;
  using Vertex = std::uint32_t;

  /// O(n^2 / 64 + edges).
  explicit RipsGroups(const RipsGraph& graph);
  /// What it takes, n^2 / 8 bytes, is a fraction of what the graph takes, or little.
  static bool are_affordable(const RipsGraph& graph);

  /// Goes to the simplices whose longest edge is `key`, fast if they are near those at hand.
  /// @return whether the link is empty: then the edge is the only one.
  bool go_to(Key key);

  /// Calls `visit(vertices)` for each clique of `size` > 0 vertices of the link that is, together
  /// with e, in no apparent pair: its vertices, descending. The cliques come in descending
  /// colexicographic order. Calls `on_step()` now and then.
  template <class Visit, class OnStep>
  void for_each_unmatched(int size, Visit&& visit, OnStep&& on_step) {
    sets_.resize(static_cast<std::size_t>(size) * link_words_.size());
    chosen_.clear();
    extend(size, 0, link_words_.size(), visit, on_step);
  }

 private:
  using Word = BitMatrix::Word;

  /// Sets are words of the link that are not zero: word i of a set is word link_words_[i] of a row.
  Word* set(std::size_t depth) { return sets_.data() + depth * link_words_.size(); }

  /// Adds `missing` vertices to the clique chosen, all from the set at `depth`: those of the link
  /// that are joined to all of the clique and below it. The set fills `words` words.
  template <class Visit, class OnStep>
  void extend(int missing, std::size_t depth, std::size_t words, Visit& visit, OnStep& on_step);

  /// Whether vertex `a`, the first of a set, is joined to all others.
  bool sees_all(Vertex a, const Word* set, std::size_t first, std::size_t words) const {
    const Word* joined = present_.row(a);
    Word missed = set[first] & ~joined[link_words_[first]] & ~(Word{1} << (a % 64));
    for (std::size_t i = first + 1; missed == 0 && i < words; ++i)
      missed = set[i] & ~joined[link_words_[i]];
    return missed == 0;
  }

  std::span<const FlagEdge> edges_;
  Key key_;            // edges before it are present
  BitMatrix present_;  // symmetric
  std::pmr::vector<std::uint32_t> link_words_;
  std::pmr::vector<Word> sets_;  // one for each vertex of a clique; the first is the link
  std::pmr::vector<Vertex> chosen_;
};

// The first vertex a of the set, if it is joined to all others, makes an apparent pair of every
// clique without it, with a added, and of every clique with it. Otherwise, for the last vertex m of
// the clique: m = a is taken away in an apparent pair; if some w < m of the set is joined to m, the
// first such w is added in one; else there is no pair.
template <class Visit, class OnStep>
void RipsGroups::extend(int missing, std::size_t depth, std::size_t words, Visit& visit,
                        OnStep& on_step) {
  on_step();
  const Word* common = set(depth);
  std::size_t first = 0;
  while (first < words && common[first] == 0) ++first;
  if (first == words) return;
  const auto lowest = static_cast<Vertex>(link_words_[first] * 64) +
                      static_cast<Vertex>(std::countr_zero(common[first]));
  if (sees_all(lowest, common, first, words)) return;
  for (std::size_t k = words; k-- > first;) {
    for (Word rest = common[k]; rest != 0;) {
      const int bit = 63 - std::countl_zero(rest);
      rest ^= Word{1} << bit;
      const auto x = static_cast<Vertex>(link_words_[k] * 64 + static_cast<Vertex>(bit));
      if (x == lowest) return;
      const Word* joined = present_.row(x);
      const Word last = common[k] & joined[link_words_[k]] & ((Word{1} << bit) - 1);
      chosen_.push_back(x);
      if (missing == 1) {
        bool is_matched = last != 0;
        for (std::size_t i = first; !is_matched && i < k; ++i)
          is_matched = (common[i] & joined[link_words_[i]]) != 0;
        if (!is_matched) visit(std::span<const Vertex>(chosen_));
      } else {
        Word* next = set(depth + 1);
        for (std::size_t i = 0; i < k; ++i) next[i] = common[i] & joined[link_words_[i]];
        next[k] = last;
        extend(missing - 1, depth + 1, k + 1, visit, on_step);
      }
      chosen_.pop_back();
    }
  }
}

}  // namespace ph
