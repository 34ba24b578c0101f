// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <vector>

#include "ph/filtration.hpp"

namespace ph {

/// A base class for a complex of your own: it provides all members of Filtration except three,
/// which Derived provides:
///
///   double value(Cell) const                    when a cell enters
///   void for_each_cell(int dim, visit) const    calls visit(Cell) for each cell of that dimension
///   void for_each_facet(int dim, Cell, visit) const    calls visit(Cell, int incidence)
///
/// ph/filtration.hpp explains these members. Derived may replace the members that are defined
/// below. It can also add members of further capabilities, such as edges_join_vertices().
/// @tparam TopDim the highest dimension of a cell.
/// @tparam C the type of a cell; it has the operator <.
template <class Derived, int TopDim, std::totally_ordered C = Index>
class CellFiltration {
  static_assert(TopDim >= 0);

 public:
  using Cell = C;

  /// Finds the largest dimension that has a cell, by listing the cells of each dimension from
  /// TopDim down.
  int top_dim() const {
    for (int dim = TopDim; dim >= 0; --dim) {
      bool has_cell = false;
      derived().for_each_cell(dim, [&](const Cell&) { has_cell = true; });
      if (has_cell) return dim;
    }
    return -1;
  }
  /// Compares cells by value, and cells of equal value by <.
  bool precedes(const Cell& a, const Cell& b) const {
    const double x = derived().value(a), y = derived().value(b);
    return x != y ? x < y : a < b;
  }
  static CellKind cell_kind() { return CellKind::row; }
  /// A cell that is a number is named by that number.
  void append_input_cell(int, const Cell& cell,
                         std::vector<Index>& numbers) const requires std::integral<Cell> {
    numbers.push_back(static_cast<Index>(cell));
  }

 private:
  const Derived& derived() const { return static_cast<const Derived&>(*this); }
};

}  // namespace ph
