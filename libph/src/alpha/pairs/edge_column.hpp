// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "libph/src/alpha/intervals/intervals.hpp"
#include "libph/src/alpha/pairs/critical_simplices.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/field.hpp"

namespace ph::alpha {

/// An edge that is compared by its place in the filtration.
struct EdgeName {
  double value = 0;
  std::uint32_t edge = 0;

  friend bool operator==(const EdgeName& a, const EdgeName& b) { return a.edge == b.edge; }
  friend bool operator<(const EdgeName& a, const EdgeName& b) {
    return a.value != b.value ? a.value < b.value : a.edge < b.edge;
  }
};

/// A chain of edges under reduction, stored as a sorted list. Columns are short, and merging short
/// sorted lists is faster than a heap. If the pivot is paired with a triangle inside its interval,
/// the column adds the multiple of this triangle's boundary that cancels the pivot. Edges that join
/// components are left out, because such an edge is never the youngest edge of a cycle. An object
/// must not be shared by threads.
template <Field K>
class EdgeColumn {
 public:
  using Element = typename K::Element;
  using Term = Entry<EdgeName, K>;

  /// @param joins for each edge: true if the edge joins components.
  EdgeColumn(const AlphaCells& cells, const SimplexSet& joins, const K& field,
             const RunContext& context)
      : cells_(cells),
        joins_(joins),
        field_(field),
        context_(context),
        terms_(&context.memory),
        merged_(&context.memory) {}

  /// Replaces the chain by the boundary of a facet.
  void assign_boundary(std::uint32_t facet) {
    terms_.clear();
    add_boundary(facet, kNone, field_.from_int(1));
  }
  /// Adds `scale` times a chain. @param chain its terms, with ascending edges.
  void add(Element scale, std::span<const Entry<std::uint32_t, K>> chain) {
    count(terms_.size() + chain.size());
    const auto name = [&](std::uint32_t edge) {
      return EdgeName{cells_.edge_states[edge].value, edge};
    };
    merged_.clear();
    auto mine = terms_.begin();
    auto theirs = chain.begin();
    while (mine != terms_.end() && theirs != chain.end()) {
      if (mine->cell.edge == theirs->cell) {
        const Element sum =
            field_.add(mine->coefficient(), field_.multiply(scale, theirs->coefficient()));
        if (!field_.is_zero(sum)) merged_.emplace_back(mine->cell, sum);
        ++mine;
        ++theirs;
      } else if (mine->cell < name(theirs->cell)) {
        merged_.push_back(*mine++);
      } else {
        merged_.emplace_back(name(theirs->cell), field_.multiply(scale, theirs->coefficient()));
        ++theirs;
      }
    }
    merged_.insert(merged_.end(), mine, terms_.end());
    for (; theirs != chain.end(); ++theirs)
      merged_.emplace_back(name(theirs->cell), field_.multiply(scale, theirs->coefficient()));
    terms_.swap(merged_);
  }
  std::span<const Term> terms() const { return terms_; }
  /// Removes and returns the pivot: the youngest edge, after all younger edges that are paired with
  /// a triangle inside their interval have been cancelled. Returns nothing if the chain becomes 0.
  std::optional<Term> take_pivot() {
    while (!terms_.empty()) {
      const Term youngest = terms_.back();
      terms_.pop_back();
      const std::uint32_t facet = cells_.edge_states[youngest.cell.edge].up;
      if (facet == kCritical) return youngest;
      add_boundary(facet, youngest.cell.edge, youngest.coefficient());
    }
    return std::nullopt;
  }

 private:
  void count(std::size_t steps) {
    constexpr std::size_t many = 4096;
    if ((steps_ += steps + 1) < many) return;
    steps_ = 0;
    context_.poll();
  }
  /// If `without` is kNone, adds `coefficient` times the boundary of a facet. Otherwise adds the
  /// multiple of the boundary that cancels `coefficient` times the edge `without`, but leaves that
  /// edge out, because it has been removed already.
  void add_boundary(std::uint32_t facet, std::uint32_t without, Element coefficient) {
    count(1);
    const std::array<std::uint32_t, 3> edges = cells_.facet_edges(facet);
    // The incidences are 1, -1 and 1.
    bool is_negative = false;
    if (without != kNone) is_negative = edges[1] != without;  // mutant: alpha-step-sign
    for (std::size_t i = 0; i < 3; ++i)
      if (edges[i] != without)
        add(edges[i], is_negative != (i == 1) ? field_.negate(coefficient) : coefficient);
  }
  void add(std::uint32_t edge, Element coefficient) {
    const Edge& state = cells_.edge_states[edge];
    if (state.up == kJoins || joins_[edge]) return;
    const EdgeName name{state.value, edge};
    constexpr std::size_t few = 32;
    auto at = terms_.end();
    if (terms_.size() <= few) {
      while (at != terms_.begin() && name < (at - 1)->cell) --at;
    } else {
      at = std::upper_bound(terms_.begin(), terms_.end(), name,
                            [](const EdgeName& a, const Term& b) { return a < b.cell; });
    }
    if (at == terms_.begin() || !((at - 1)->cell == name)) {
      terms_.insert(at, Term(name, coefficient));
      return;
    }
    const Element sum = field_.add((at - 1)->coefficient(), coefficient);
    if (field_.is_zero(sum))
      terms_.erase(at - 1);
    else
      *(at - 1) = Term(name, sum);
  }

  const AlphaCells& cells_;
  const SimplexSet& joins_;
  const K& field_;
  const RunContext& context_;
  std::size_t steps_ = 0;  // the number of steps since the stop token was last polled
  std::pmr::vector<Term> terms_, merged_;
};

}  // namespace ph::alpha
