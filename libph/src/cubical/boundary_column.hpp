// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "cell_grid.hpp"
#include "ph/core/chain.hpp"
#include "ph/core/field.hpp"
#include "ph/core/run_context.hpp"

namespace ph::cubical {

/// A chain of cells that is being reduced: a heap. A cell that is killed inside its star is
/// replaced by the rest of the boundary of its killer when it comes up, so a chain is followed only
/// as far down as its pivot; cells that kill are left out (no cycle has its youngest cell there).
/// One for each thread.
template <Field K>
class BoundaryColumn {
 public:
  using Element = typename K::Element;
  using Term = Entry<CellGrid::Name, K>;

  BoundaryColumn(const CellGrid& grid, const K& field, const RunContext& context)
      : grid_(grid), field_(field), context_(context), heap_(&context.memory) {}

  /// Begins anew with the boundary of a cell.
  void assign_boundary(std::uint32_t cell) {
    heap_.clear();
    add_boundary(cell, grid_.coordinates(cell), CellGrid::kNone, field_.from_int(1));
  }
  /// Begins anew with a chain.
  void assign(std::span<const Term> chain) {
    heap_.assign(chain.begin(), chain.end());
    std::make_heap(heap_.begin(), heap_.end(), precedes);
  }
  void add(Element scale, std::span<const Term> chain) {
    const std::size_t before = heap_.size();
    for (const Term& term : chain) append(term.cell, field_.multiply(scale, term.coefficient()));
    push_from(before);
  }
  /// Takes out the youngest cell that is in no pair inside its star; nothing if none is left.
  std::optional<Term> take_pivot() {
    while (const std::optional<Term> youngest = take_youngest()) {
      const std::uint32_t cell = CellGrid::cell(youngest->cell);
      const CellMark mark = grid_.mark(cell);
      if (!mark.is_killed()) return youngest;
      CellGrid::Coordinates x = grid_.coordinates(cell);
      const int direction = mark.direction();
      const auto axis = static_cast<std::size_t>(direction / 2);
      // The incidence of the cell in its killer, of which it is the lower end if that lies above.
      bool is_negative = direction % 2 != 0;
      for (std::size_t k = 0; k < axis; ++k) is_negative = is_negative != (x[k] % 2 != 0);
      const std::uint32_t killer = grid_.beside(cell, x[axis], direction);
      x[axis] = grid_.next(x[axis], direction);
      const Element a = youngest->coefficient();
      add_boundary(killer, x, cell, is_negative ? a : field_.negate(a));
    }
    return std::nullopt;
  }
  /// What it holds, each cell once; to be assigned before it is used again.
  std::span<const Term> consolidate() {
    std::sort(heap_.begin(), heap_.end(), precedes);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < heap_.size();) {
      const CellGrid::Name name = heap_[i].cell;
      Element sum = heap_[i].coefficient();
      for (++i; i < heap_.size() && heap_[i].cell == name; ++i)
        sum = field_.add(sum, heap_[i].coefficient());
      if (!field_.is_zero(sum)) heap_[kept++] = Term(name, sum);
    }
    heap_.resize(kept);
    return heap_;
  }

 private:
  static bool precedes(const Term& a, const Term& b) { return a.cell < b.cell; }

  void append(CellGrid::Name name, Element a) { heap_.emplace_back(name, a); }
  // Puts what was appended where it belongs.
  void push_from(std::size_t before) {
    const std::size_t added = heap_.size() - before;
    constexpr std::size_t many = 4096;
    steps_ += added + 1;
    if (steps_ >= many) {
      steps_ = 0;
      context_.poll();
    }
    if (added > before) return std::make_heap(heap_.begin(), heap_.end(), precedes);
    for (std::size_t i = before + 1; i <= heap_.size(); ++i)
      std::push_heap(heap_.begin(), heap_.begin() + static_cast<std::ptrdiff_t>(i), precedes);
  }
  // Adds `scale` times the boundary of a cell, but for the facet `skip`. @param at where it is.
  void add_boundary(std::uint32_t cell, const CellGrid::Coordinates& at, std::uint32_t skip,
                    Element scale) {
    const std::size_t before = heap_.size();
    grid_.for_each_facet(
        cell, at, [&](std::uint32_t facet, const CellGrid::Coordinates& x, int incidence) {
          if (facet == skip || grid_.mark(facet).kills()) return;
          append(grid_.name(facet, x), incidence > 0 ? scale : field_.negate(scale));
        });
    push_from(before);
  }
  Term pop() {
    std::pop_heap(heap_.begin(), heap_.end(), precedes);
    const Term term = heap_.back();
    heap_.pop_back();
    return term;
  }
  std::optional<Term> take_youngest() {
    while (!heap_.empty()) {
      const Term first = pop();
      Element sum = first.coefficient();
      while (!heap_.empty() && heap_.front().cell == first.cell)
        sum = field_.add(sum, pop().coefficient());
      if (!field_.is_zero(sum)) return Term(first.cell, sum);
    }
    return std::nullopt;
  }

  const CellGrid& grid_;
  const K& field_;
  const RunContext& context_;
  std::size_t steps_ = 0;  // since the last look at the stop token
  std::pmr::vector<Term> heap_;
};

}  // namespace ph::cubical
