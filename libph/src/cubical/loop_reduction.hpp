// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "ph/core/chain.hpp"
#include "ph/core/field.hpp"
#include "ph/core/radix_sort.hpp"
#include "two_graphs.hpp"

namespace ph::cubical {

/// H1 of three axes: boundaries of the critical squares that are left, oldest first, reduced to
/// critical edges that are left. An edge that is paired inside its star is replaced by the rest of
/// the boundary of its square when it comes up as the pivot, so a column is followed only as far
/// down as its pivot; edges that kill a component are left out (no column has its pivot there).
template <Field K>
class LoopReduction {
 public:
  /// @param squares of which those in the order give birth to nothing.
  LoopReduction(const StarGrid& grid, const CriticalCells& squares, const K& field,
                const RunContext& context, PairSink& sink)
      : grid_(grid),
        squares_(squares),
        field_(field),
        sink_(sink),
        context_(context),
        critical_at_(grid.size(), kNone, &context.memory),
        first_owner_(&context.memory),
        owners_(&context.memory),
        columns_(&context.memory),
        terms_(&context.memory),
        heap_(&context.memory) {}

  void run() {
    Ticker ticker(context_, "loops", squares_.order.size());
    number_edges(ticker);
    for (const auto& [value, cell] : squares_.order) {
      ticker.tick();
      reduce(squares_.cells[cell], value, ticker);
    }
    report_essential(ticker);
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;
  using Element = typename K::Element;
  // Of an edge: (the voxel, the rank of the direction in the star).
  using Name = std::uint64_t;
  struct Edge {
    std::uint64_t key;  // orders as the value does
    Name name;
    friend bool operator==(const Edge& a, const Edge& b) { return a.name == b.name; }
  };
  using Term = Entry<Edge, K>;
  static bool precedes(const Term& a, const Term& b) {
    return a.cell.key != b.cell.key ? a.cell.key < b.cell.key : a.cell.name < b.cell.name;
  }
  struct Column {
    std::size_t begin, end;  // in terms_
    Element pivot;
  };

  static std::uint32_t voxel_of(Name name) { return static_cast<std::uint32_t>(name >> 3); }
  void append(Name name, Element coefficient) {
    heap_.emplace_back(Edge{ordered_bits(grid_.value(voxel_of(name)) + 0.0), name}, coefficient);
  }
  // The edges of the stars that may be pivots, by critical voxel.
  unsigned free_edges(std::size_t i) const {
    const std::uint32_t v = grid_.critical()[i];
    return grid_.tables(v).free_edges(grid_.star(v));
  }
  void number_edges(Ticker& ticker) {
    const auto critical = grid_.critical();
    first_owner_.reserve(critical.size());
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < critical.size(); ++i) {
      ticker.work();
      critical_at_[critical[i]] = static_cast<std::uint32_t>(i);
      first_owner_.push_back(count);
      count += static_cast<std::uint32_t>(std::popcount(free_edges(i)));
    }
    owners_.assign(count, kNone);
  }
  // Where the owner of a critical edge is noted; null if the edge is no pivot.
  std::uint32_t* owner_of(std::uint32_t voxel, int edge) {
    const std::uint32_t i = critical_at_[voxel];
    if (i == kNone) return nullptr;
    const unsigned edges = free_edges(i);
    if ((edges >> edge & 1U) == 0) return nullptr;
    const auto before = static_cast<std::uint32_t>(std::popcount(edges & ((1U << edge) - 1)));
    return &owners_[first_owner_[i] + before];
  }

  // Appends an edge of a star unless it kills.
  void append_in_star(std::uint32_t v, int edge, Element coefficient) {
    const std::uint32_t star = grid_.star(v);
    const StarTables& tables = grid_.tables(v);
    // Kills v, or a component.
    if (tables.arrow(star) == edge || (star & tables.taken_mark(edge)) != 0) return;
    append(Name{v} << 3 | static_cast<Name>(tables.edge_order().rank(edge)), coefficient);
  }

  // Appends `scale` times the boundary of a square, without the edge `skip` of its voxel if it is
  // not negative. Incidences as in complex/cubical_cells.ipp.
  void append_boundary(std::uint32_t v, int square, Element scale, int skip) {
    const auto [first, second] = kEdgesOfSquare[square];
    const int a = axis_of_edge(first), b = axis_of_edge(second);
    const int at = kSquares[square][a], bt = kSquares[square][b];  // where the square lies
    if (second != skip) append_in_star(v, second, times(scale, -at));
    if (first != skip) append_in_star(v, first, times(scale, bt));
    const std::uint32_t over_a = grid_.step(v, a, at), over_b = grid_.step(v, b, bt);
    append_far(over_a, over_b, a, at, b, bt, times(scale, at), times(scale, -bt));
  }
  Element times(Element scale, int sign) const { return sign > 0 ? scale : field_.negate(scale); }
  // The two edges of a square that do not touch its voxel.
  void append_far(std::uint32_t over_a, std::uint32_t over_b, int a, int at, int b, int bt,
                  Element along_b, Element along_a) {
    std::uint32_t corner = StarGrid::kOutside;
    if (over_a != StarGrid::kOutside)
      corner = grid_.step(over_a, b, bt);
    else if (over_b != StarGrid::kOutside)
      corner = grid_.step(over_b, a, at);
    append_between(over_a, corner, b, bt, along_b);
    append_between(over_b, corner, a, at, along_a);
  }
  // The edge from u to w, one step along an axis; either may be no voxel.
  void append_between(std::uint32_t u, std::uint32_t w, int axis, int sign, Element coefficient) {
    Direction d{};
    d[axis] = sign;
    if (u != StarGrid::kOutside && grid_.enters(u) && (grid_.star(u) & star_bit(d)) != 0) {
      append_in_star(u, number_of(d), coefficient);
      return;
    }
    d[axis] = -sign;
    if (w != StarGrid::kOutside && grid_.enters(w)) append_in_star(w, number_of(d), coefficient);
  }

  bool pop(Term& pivot) {
    while (!heap_.empty()) {
      take(pivot);
      Element sum = pivot.coefficient();
      while (!heap_.empty() && heap_.front().cell == pivot.cell) {
        Term more;
        take(more);
        sum = field_.add(sum, more.coefficient());
      }
      if (field_.is_zero(sum)) continue;
      pivot = Term(pivot.cell, sum);
      return true;
    }
    return false;
  }
  void take(Term& term) {
    std::pop_heap(heap_.begin(), heap_.end(), precedes);
    term = heap_.back();
    heap_.pop_back();
  }
  template <class Append>
  void push(Append&& append_terms) {
    const std::size_t before = heap_.size();
    append_terms();
    for (std::size_t i = before + 1; i <= heap_.size(); ++i)
      std::push_heap(heap_.begin(), heap_.begin() + static_cast<std::ptrdiff_t>(i), precedes);
  }

  void reduce(const NumberedCell& column_cell, double value, Ticker& ticker) {
    const std::uint32_t v = column_cell.voxel;
    const int square = static_cast<int>(column_cell.number);
    heap_.clear();
    push([&] { append_boundary(v, square, field_.from_int(1), -1); });
    Term pivot;
    while (pop(pivot)) {
      ticker.work();
      const std::uint32_t u = voxel_of(pivot.cell.name);
      const StarTables& tables = grid_.tables(u);
      const int edge = tables.edge_order().at(static_cast<int>(pivot.cell.name & 7));
      if (const int s = tables.square_of(grid_.star(u), edge); s >= 0) {
        const auto [first, second] = kEdgesOfSquare[s];
        const int incidence =
            edge == second ? -kSquares[s][axis_of_edge(first)] : kSquares[s][axis_of_edge(second)];
        const Element scale = field_.negate(times(pivot.coefficient(), incidence));
        push([&] { append_boundary(u, s, scale, edge); });
        continue;
      }
      std::uint32_t* owner = owner_of(u, edge);
      if (owner == nullptr) continue;
      if (*owner == kNone) {
        *owner = static_cast<std::uint32_t>(columns_.size());
        store(pivot.coefficient());
        sink_.pair(1, {u, kEdges[edge], grid_.value(u)}, {v, kSquares[square], value});
        return;
      }
      const Column& column = columns_[*owner];
      const Element scale =
          field_.negate(field_.multiply(pivot.coefficient(), field_.inverse(column.pivot)));
      push([&] {
        for (std::size_t i = column.begin; i < column.end; ++i)
          heap_.emplace_back(terms_[i].cell, field_.multiply(scale, terms_[i].coefficient()));
      });
      ticker.work(column.end - column.begin);
    }
    sink_.essential(2, {v, kSquares[square], value});
  }
  // Keeps what the working column has below its pivot.
  void store(Element pivot) {
    std::sort(heap_.begin(), heap_.end(),
              [](const Term& a, const Term& b) { return a.cell.name < b.cell.name; });
    Column column{terms_.size(), 0, pivot};
    for (std::size_t i = 0; i < heap_.size();) {
      const Edge edge = heap_[i].cell;
      Element sum = heap_[i].coefficient();
      for (++i; i < heap_.size() && heap_[i].cell == edge; ++i)
        sum = field_.add(sum, heap_[i].coefficient());
      if (!field_.is_zero(sum)) terms_.emplace_back(edge, sum);
    }
    column.end = terms_.size();
    columns_.push_back(column);
  }
  void report_essential(Ticker& ticker) {
    for (std::size_t i = 0; i < grid_.critical().size(); ++i) {
      ticker.work();
      for (unsigned rest = free_edges(i); rest != 0; rest &= rest - 1) {
        const std::uint32_t v = grid_.critical()[i];
        const int edge = std::countr_zero(rest);
        if (*owner_of(v, edge) == kNone)
          sink_.essential(1, {v, kEdges[static_cast<std::size_t>(edge)], grid_.value(v)});
      }
    }
  }

  const StarGrid& grid_;
  const CriticalCells& squares_;
  const K& field_;
  PairSink& sink_;
  const RunContext& context_;
  std::pmr::vector<std::uint32_t> critical_at_;  // by voxel
  std::pmr::vector<std::uint32_t> first_owner_;  // by critical voxel
  std::pmr::vector<std::uint32_t> owners_;       // of critical edges: a column
  std::pmr::vector<Column> columns_;
  std::pmr::vector<Term> terms_;
  std::pmr::vector<Term> heap_;
};

}  // namespace ph::cubical
