// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "libph/src/cubical/columns/chain_heap.hpp"
#include "libph/src/cubical/grid/cell_grid.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// A chain of cells under reduction. If the pivot is a cell that is killed inside its star, the
/// pivot is replaced by the rest of the boundary of its killer. A chain is therefore expanded only
/// down to its pivot. Cells that kill other cells are left out, because such a cell is never the
/// youngest cell of a cycle. An object must not be shared by threads.
template <Field K>
class BoundaryColumn {
 public:
  using Element = typename K::Element;
  using Term = Entry<CellGrid::Name, K>;

  BoundaryColumn(const CellGrid& grid, const K& field, const RunContext& context)
      : grid_(grid), field_(field), context_(context), heap_(field, &context.memory) {}

  /// Replaces the chain by the boundary of a cell.
  void assign_boundary(std::uint32_t cell) {
    heap_.clear();
    add_boundary(cell, grid_.coordinates(cell), CellGrid::kNone, field_.from_int(1));
  }
  /// Replaces the chain by another chain.
  void assign(std::span<const Term> chain) { heap_.assign(chain); }
  void add(Element scale, std::span<const Term> chain) {
    count(chain.size());
    heap_.add([&](Terms& terms) {
      for (const Term& term : chain)
        terms.emplace_back(term.cell, field_.multiply(scale, term.coefficient()));
    });
  }
  /// Removes and returns the pivot: the youngest cell that is in no pair inside its star. Returns
  /// nothing if the chain becomes 0.
  std::optional<Term> take_pivot() {
    return heap_.take_pivot([this](const Term& term) { return replace(term); });
  }
  /// Called before the chain is kept. Replaces about as many cells below the pivot as the chain has
  /// terms. Columns to which the chain is added then need not replace these cells again, and many
  /// terms cancel.
  /// @return the pivot; all other cells are older.
  std::optional<Term> settle(const Term& pivot) {
    return heap_.follow(pivot, heap_.size(), [this](const Term& term) { return replace(term); });
  }
  /// The terms of the chain, from young to old. Each cell occurs once.
  std::span<const Term> consolidate() { return heap_.consolidate(); }

 private:
  using Terms = std::pmr::vector<Term>;

  // Takes a cell that has been removed, and adds the rest of the boundary of its killer instead.
  // @return true if the cell has a killer inside its star.
  bool replace(const Term& term) {
    const std::uint32_t cell = CellGrid::cell(term.cell);
    const CellMark mark = grid_.mark(cell);
    if (!mark.is_killed()) return false;
    CellGrid::Coordinates x = grid_.coordinates(cell);
    const int direction = mark.direction();
    const auto axis = static_cast<std::size_t>(direction / 2);
    // This is the sign of the cell's incidence in its killer. If the killer lies above the cell,
    // the cell is the lower end of the killer.
    bool is_negative = direction % 2 != 0;
    for (std::size_t k = 0; k < axis; ++k) is_negative = is_negative != (x[k] % 2 != 0);
    const std::uint32_t killer = grid_.beside(cell, x[axis], direction);
    x[axis] = grid_.next(x[axis], direction);
    const Element a = term.coefficient();
    add_boundary(killer, x, cell, is_negative ? a : field_.negate(a));
    return true;
  }
  static bool precedes(CellGrid::Name a, CellGrid::Name b) { return a < b; }
  void count(std::size_t steps) {
    constexpr std::size_t many = 4096;
    if ((steps_ += steps + 1) < many) return;
    steps_ = 0;
    context_.poll();
  }
  // Adds `scale` times the boundary of a cell, except for the facet `skip`. @param at the
  // coordinates of the cell.
  void add_boundary(std::uint32_t cell, const CellGrid::Coordinates& at, std::uint32_t skip,
                    Element scale) {
    count(1);
    heap_.add([&](Terms& terms) {
      grid_.for_each_facet(
          cell, at, [&](std::uint32_t facet, const CellGrid::Coordinates& x, int incidence) {
            if (facet == skip || grid_.mark(facet).kills()) return;
            terms.emplace_back(grid_.name(facet, x), incidence > 0 ? scale : field_.negate(scale));
          });
    });
  }

  const CellGrid& grid_;
  const K& field_;
  const RunContext& context_;
  std::size_t steps_ = 0;  // the number of steps since the stop token was last polled
  ChainHeap<K, Term, &BoundaryColumn::precedes> heap_;
};

}  // namespace ph::cubical
