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

/// Lists simplices by their longest edge e, one edge after another, as cliques of the link of e.
/// The link consists of the vertices that edges before e join to both ends of e. This class finds
/// the simplices that are in no apparent pair without looking at most of the others; see
/// docs/explanation/engines/cohomology.md.
class RipsGroups {
 public:
  using Key = RipsGraph::Key;
  using Vertex = std::uint32_t;

  /// O(n^2 / 64 + edges).
  explicit RipsGroups(const RipsGraph& graph);
  /// True if n^2 / 8 bytes, the size of this object, are little memory, in absolute terms or
  /// compared with the graph.
  static bool are_affordable(const RipsGraph& graph);

  /// Goes to the simplices whose longest edge is `key`, which is fast if `key` is near the current
  /// key.
  /// @return true if the link is empty: then the edge is the only such simplex.
  bool go_to(Key key);

  /// Calls `visit(vertices)` with the vertices, descending, of each clique of `size` > 0 vertices
  /// of the link that together with e is in no apparent pair. The cliques come in descending
  /// colexicographic order. Calls `on_step()` now and then.
  template <class Visit, class OnStep>
  void for_each_unmatched(int size, Visit&& visit, OnStep&& on_step) {
    sets_.resize(static_cast<std::size_t>(size) * link_words_.size());
    chosen_.clear();
    extend(size, 0, link_words_.size(), visit, on_step);
  }

 private:
  using Word = BitMatrix::Word;

  /// A set of vertices stores only the words that are not zero in the link: word i of a set is word
  /// link_words_[i] of a row.
  Word* set(std::size_t depth) { return sets_.data() + depth * link_words_.size(); }

  /// Adds `missing` vertices to the chosen clique, all from the set at `depth`: the vertices of the
  /// link that are below the clique and joined to all its vertices. The set fills `words` words.
  template <class Visit, class OnStep>
  void extend(int missing, std::size_t depth, std::size_t words, Visit& visit, OnStep& on_step);

  /// True if vertex `a`, the first of a set, is joined to all others.
  bool sees_all(Vertex a, const Word* set, std::size_t first, std::size_t words) const {
    const Word* joined = present_.row(a);
    Word missed = set[first] & ~joined[link_words_[first]] & ~(Word{1} << (a % 64));
    for (std::size_t i = first + 1; missed == 0 && i < words; ++i)
      missed = set[i] & ~joined[link_words_[i]];
    return missed == 0;  // mutant: rips-cone
  }

  std::span<const FlagEdge> edges_;
  Key key_;            // present_ holds the edges before this one
  BitMatrix present_;  // symmetric
  std::pmr::vector<std::uint32_t> link_words_;
  std::pmr::vector<Word> sets_;  // one set per vertex of a clique; the first set is the link
  std::pmr::vector<Vertex> chosen_;
};

// If the first vertex a of the set is joined to all others, it forms apparent pairs: every clique
// without a is paired with the same clique plus a. Otherwise let m be the last vertex of the
// clique. If m = a, removing m gives an apparent pair. If some w < m of the set is joined to m,
// adding the first such w gives one. Otherwise there is none.
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
      if (x == lowest) return;  // mutant: rips-lowest
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
