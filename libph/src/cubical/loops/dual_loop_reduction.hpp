// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cubical/columns/chain_heap.hpp"
#include "cubical/stars/critical_cells.hpp"
#include "cubical/stars/facet_search.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/detail/core/radix_sort.hpp"

namespace ph::cubical {

/// H1 of the T-construction of three axes, with cycles. Its edges are the squares of the stars'
/// grid, its squares are the edges there, and its boundary is the coboundary: what `LoopReduction`
/// does, seen from the other side and backwards. By one thread.
template <Field K>
class DualLoopReduction {
 public:
  using Element = typename K::Element;
  /// A square, ordered as in the stars' grid: by value, voxel, rank of the direction.
  struct Square {
    std::uint64_t key, name;
    std::uint32_t voxel() const { return static_cast<std::uint32_t>(name >> 4); }
    int rank() const { return static_cast<int>(name & 15); }
    friend bool operator==(const Square& a, const Square& b) { return a.name == b.name; }
    /// The youngest edge of T is the oldest square.
    static bool is_later(const Square& a, const Square& b) {
      return a.key != b.key ? a.key > b.key : a.name > b.name;
    }
  };
  using Term = Entry<Square, K>;
  struct Column {
    std::optional<Term> pivot;  ///< nothing: it is zero
    std::pmr::vector<Term> below;
  };

  /// @param edges,squares those in the orders are in no pair of the two graphs.
  DualLoopReduction(const StarGrid& grid, const CriticalCells& edges, const CriticalCells& squares,
                    const K& field, const RunContext& context)
      : grid_(grid),
        edges_(edges),
        squares_(squares),
        field_(field),
        context_(context),
        is_free_(squares.cells.size(), false, &context.memory),
        owners_(squares.cells.size(), kNone, &context.memory),
        columns_(&context.memory),
        heap_(field, &context.memory) {
    for (const auto& place : squares.order) is_free_[place.cell] = true;
  }

  void reduce() {
    Ticker ticker(context_, "loops", edges_.order.size());
    columns_.reserve(edges_.order.size());
    for (std::size_t i = edges_.order.size(); i-- > 0;) {  // the oldest square of T first
      ticker.tick();
      const auto [v, edge] = edges_.cells[edges_.order[i].cell];
      heap_.clear();
      add_coboundary(v, static_cast<int>(edge), field_.from_int(1), -1);
      Column& own = columns_.emplace_back(std::nullopt, std::pmr::vector<Term>(&context_.memory));
      std::uint32_t index = 0;
      while (const std::optional<Term> pivot = take_pivot(index, ticker)) {
        if (owners_[index] == kNone) {
          owners_[index] = static_cast<std::uint32_t>(columns_.size() - 1);
          own.pivot = pivot;
          const auto below = heap_.consolidate();
          own.below.assign(below.begin(), below.end());
          break;
        }
        const Column& older = columns_[owners_[index]];
        const Element scale = field_.negate(
            field_.multiply(pivot->coefficient(), field_.inverse(older.pivot->coefficient())));
        ticker.work(older.below.size());
        heap_.add([&](Terms& terms) {
          for (const Term& term : older.below)
            terms.emplace_back(term.cell, field_.multiply(scale, term.coefficient()));
        });
      }
    }
  }

  /// Calls `on_pair(edge, square, pivot, rest of the cycle)` for each loop of T that dies,
  /// `on_surface(edge)` for each column that is zero, `on_loop(square)` for each loop that never
  /// dies.
  template <class OnPair, class OnSurface, class OnLoop>
  void for_each_class(OnPair&& on_pair, OnSurface&& on_surface, OnLoop&& on_loop) const {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const auto [value, cell] = edges_.order[edges_.order.size() - 1 - i];
      const StarCell edge{edges_.cells[cell].voxel, kEdges[edges_.cells[cell].number], value};
      if (const auto& [pivot, below] = columns_[i]; pivot)
        on_pair(edge, this->cell(pivot->cell), *pivot, std::span<const Term>(below));
      else
        on_surface(edge);
    }
    for (const auto& [value, cell] : squares_.order)
      if (owners_[cell] == kNone)
        on_loop(StarCell{squares_.cells[cell].voxel, kSquares[squares_.cells[cell].number], value});
  }
  StarCell cell(const Square& square) const {
    const std::uint32_t v = square.voxel();
    return {v, kSquares[grid_.tables(v).square_order().at(square.rank())], grid_.value(v)};
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  using Terms = std::pmr::vector<Term>;

  // The boundary of an edge is known but for its sign by where a square lies beside it.
  static int incidence(int edge, int square) {
    const int along = axis_of_edge(edge);
    int first = along == 0 ? 1 : 0;
    const bool beside_first = kSquares[square][first] != 0;
    const int axis = beside_first ? first : 3 - along - first;
    // Axes of T run backwards: what lies below in the stars' grid is its upper end.
    return beside_first ? -kSquares[square][axis] : kSquares[square][axis];
  }
  // Appends `scale` times the squares around an edge of the star of v, without the square `skip` of
  // that star if it is not negative.
  void add_coboundary(std::uint32_t v, int edge, Element scale, int skip) {
    heap_.add([&](Terms& terms) { append_coboundary(v, edge, scale, skip, terms); });
  }
  void append_coboundary(std::uint32_t v, int edge, Element scale, int skip, Terms& terms) {
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
  }
  // Unless the square is an edge of T that joins components inside its star.
  void append(const StarCell& square, Element coefficient, Terms& terms) {
    const std::uint32_t v = square.voxel;
    const int number = number_of(square.direction);
    if ((grid_.pair_cubes(v).squares() >> number & 1U) != 0) return;
    const auto rank = static_cast<std::uint64_t>(grid_.tables(v).square_order().rank(number));
    terms.emplace_back(Square{ordered_bits(square.value + 0.0), std::uint64_t{v} << 4 | rank},
                       coefficient);
  }
  // @param index of it among the critical squares.
  std::optional<Term> take_pivot(std::uint32_t& index, Ticker& ticker) {
    while (const std::optional<Term> term = heap_.take()) {
      ticker.work();
      const std::uint32_t v = term->cell.voxel();
      const std::uint32_t star = grid_.star(v);
      const StarTables& tables = grid_.tables(v);
      const int square = tables.square_order().at(term->cell.rank());
      if ((tables.edge_squares(star) >> square & 1U) != 0) {
        const int edge = tables.edge_of(star, square);
        const Element a = term->coefficient();
        add_coboundary(v, edge, incidence(edge, square) > 0 ? field_.negate(a) : a, square);
        continue;
      }
      index = index_of(v, square);
      if (is_free_[index]) return term;
    }
    return std::nullopt;
  }
  std::uint32_t index_of(std::uint32_t v, int square) const {
    auto at = std::ranges::lower_bound(squares_.cells, v, {}, &NumberedCell::voxel);
    while (at->number != static_cast<std::uint32_t>(square)) ++at;
    return static_cast<std::uint32_t>(at - squares_.cells.begin());
  }
  const StarGrid& grid_;
  const CriticalCells &edges_, &squares_;
  const K& field_;
  const RunContext& context_;
  std::pmr::vector<bool> is_free_;          // by critical square
  std::pmr::vector<std::uint32_t> owners_;  // by critical square: a column
  std::pmr::vector<Column> columns_;        // in the order of T
  ChainHeap<K, Term, &Square::is_later> heap_;
};

}  // namespace ph::cubical
