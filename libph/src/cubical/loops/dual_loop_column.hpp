// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "libph/src/cubical/columns/chain_heap.hpp"
#include "libph/src/cubical/columns/ordered_cell.hpp"
#include "libph/src/cubical/stars/critical_cells.hpp"
#include "libph/src/cubical/stars/facet_search.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/field.hpp"

namespace ph::cubical {

/// An edge of the T-construction (T), which is a square of the stars' grid (GridFrame). The
/// youngest edge of T is the oldest square of the stars' grid.
using DualEdge = LoopSquare;

/// The edges of T that may give birth to loops. These are the critical squares that neither of the
/// two graphs pairs.
class FreeDualEdges {
 public:
  /// @param squares the critical squares; the squares listed in `squares.order` are in no pair.
  /// `squares` must outlive this object.
  FreeDualEdges(const StarGrid& grid, const CriticalCells& squares,
                std::pmr::memory_resource* memory)
      : grid_(grid), squares_(squares), is_free_(squares.cells.size(), false, memory) {
    for (const auto& place : squares.order) is_free_[place.cell] = true;
  }
  /// The position of an edge among the critical squares. Precondition: the edge is critical.
  std::uint32_t number(const DualEdge& edge) const {
    const std::uint32_t v = grid_.here(edge.voxel());
    const int square = grid_.tables(v).square_order().at(edge.rank());
    auto at = std::ranges::lower_bound(squares_.cells, v, {}, &NumberedCell::voxel);
    while (at->number != static_cast<std::uint32_t>(square)) ++at;
    return static_cast<std::uint32_t>(at - squares_.cells.begin());
  }
  bool contains(const DualEdge& edge) const { return is_free_[number(edge)]; }

 private:
  const StarGrid& grid_;
  const CriticalCells& squares_;
  std::pmr::vector<bool> is_free_;  // indexed by critical square
};

/// A chain of edges of T under reduction. It is the dual of LoopColumn, in reverse order. The
/// squares of T are the edges of the stars' grid, and the boundary in T is the coboundary in that
/// grid.
template <Field K>
class DualLoopColumn {
 public:
  using Element = typename K::Element;
  using Term = Entry<DualEdge, K>;

  DualLoopColumn(const StarGrid& grid, const FreeDualEdges& free, const K& field,
                 const RunContext& context)
      : grid_(grid), free_(free), field_(field), context_(context), heap_(field, &context.memory) {}

  /// Replaces the chain by the boundary of a square of T, which is an edge in the star of v.
  void assign_boundary(std::uint32_t v, int edge) {
    heap_.clear();
    add_coboundary(v, edge, field_.from_int(1), -1);
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
  /// Removes and returns the pivot: the youngest free edge. Returns nothing if the chain becomes 0.
  std::optional<Term> take_pivot() {
    while (const std::optional<Term> term = heap_.take()) {
      count(1);
      const std::uint32_t v = grid_.here(term->cell.voxel());
      const std::uint32_t star = grid_.star(v);
      const StarTables& tables = grid_.tables(v);
      const int square = tables.square_order().at(term->cell.rank());
      if ((tables.edge_squares(star) >> square & 1U) != 0) {
        const int edge = tables.edge_of(star, square);
        const Element a = term->coefficient();
        add_coboundary(v, edge, incidence(edge, square) > 0 ? field_.negate(a) : a, square);
      } else if (free_.contains(term->cell)) {
        return term;
      }
    }
    return std::nullopt;
  }
  /// The terms of the chain, from young to old. Each edge occurs once.
  std::span<const Term> consolidate() { return heap_.consolidate(); }

 private:
  using Terms = std::pmr::vector<Term>;

  void count(std::size_t steps) {
    constexpr std::size_t many = 4096;
    if ((steps_ += steps) < many) return;
    steps_ = 0;
    context_.poll();
  }
  // The incidence of a square and one of its edges, up to a sign that depends only on the edge.
  static int incidence(int edge, int square) {
    const int along = axis_of_edge(edge);
    int first = along == 0 ? 1 : 0;
    const bool beside_first = kSquares[square][first] != 0;
    const int axis = beside_first ? first : 3 - along - first;
    // The axes of T run backwards. The lower end in the stars' grid is therefore the upper end in
    // T.
    return beside_first ? -kSquares[square][axis] : kSquares[square][axis];
  }
  // Adds `scale` times the coboundary of an edge in the star of v. Leaves out the square `skip` of
  // that star, unless `skip` is negative.
  void add_coboundary(std::uint32_t v, int edge, Element scale, int skip) {
    heap_.add([&](Terms& terms) {
      const int along = axis_of_edge(edge);
      for (int a = 0; a < 3; ++a) {
        if (a == along) continue;
        for (const int sign : {-1, 1}) {
          const Direction d = turned(kEdges[edge], a, sign);
          const int seen = number_of(d);
          const auto square = in_its_star(grid_, v, d);
          if (!square || (square->voxel == v && number_of(square->direction) == skip)) continue;
          append(*square, incidence(edge, seen) > 0 ? scale : field_.negate(scale), terms);
        }
      }
    });
  }
  // Appends a square, unless it is an edge of T that joins components inside its star.
  void append(const StarCell& square, Element coefficient, Terms& terms) {
    const std::uint32_t v = square.voxel;
    const int number = number_of(square.direction);
    if ((grid_.pair_cubes(v).squares() >> number & 1U) != 0) return;
    terms.emplace_back(DualEdge::of(square.value, v, grid_.tables(v).square_order().rank(number)),
                       coefficient);
  }

  const StarGrid& grid_;
  const FreeDualEdges& free_;
  const K& field_;
  const RunContext& context_;
  ChainHeap<K, Term, &DualEdge::follows> heap_;
  std::size_t steps_ = 0;  // the number of steps since the stop token was last polled
};

}  // namespace ph::cubical
