// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "libph/src/cubical/columns/chain_heap.hpp"
#include "libph/src/cubical/columns/ordered_cell.hpp"
#include "libph/src/cubical/stars/star_grid.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/run_context.hpp"

namespace ph::cubical {

/// A chain of edges under reduction. If the pivot is an edge that is paired with a square inside
/// its star, the pivot is replaced by the rest of the boundary of this square. A chain is therefore
/// expanded only down to its pivot. Edges that kill a component are left out, because such an edge
/// is never the pivot of a column. An object must not be shared by threads.
/// @tparam Stars StarGrid, StoredStars, or PartStars.
template <Field K, class Stars>
class LoopColumn {
 public:
  using Element = typename K::Element;
  using Term = Entry<LoopEdge, K>;

  /// @param is_cycle true if the chain must stay a cycle when it is kept.
  LoopColumn(const Stars& grid, const K& field, const RunContext& context, bool is_cycle = false)
      : grid_(grid),
        field_(field),
        context_(context),
        is_cycle_(is_cycle),
        heap_(field, &context.memory) {}

  /// Replaces the chain by the boundary of a square.
  void assign_boundary(std::uint32_t v, int square) {
    heap_.clear();
    heap_.add([&](Terms& terms) { append_boundary(v, square, field_.from_int(1), -1, terms); });
  }
  /// Replaces the chain by another chain.
  void assign(std::span<const Term> chain) { heap_.assign(chain); }
  void add(Element scale, std::span<const Term> chain) {
    count(chain.size());
    for (const Term& term : chain) expect_star(term);
    heap_.add([&](Terms& terms) {
      for (const Term& term : chain)
        terms.emplace_back(term.cell, field_.multiply(scale, term.coefficient()));
    });
  }
  /// Removes and returns the youngest edge that either is in no pair inside its star or lies in a
  /// star that this part of the grid does not see. Returns nothing if the chain becomes 0.
  std::optional<Term> take_pivot() {
    return heap_.take_pivot([this](const Term& term) { return replace(term); });
  }
  /// Replaces edges older than a pivot that was removed, youngest first, up to a maximum number.
  /// Otherwise the chain would leave this part of the grid again and again, whenever an edge of
  /// another part becomes its pivot before older edges of this part have been replaced.
  /// @return the pivot; all other edges are older.
  std::optional<Term> follow(const Term& pivot, std::size_t most) {
    return heap_.follow(pivot, most, [this](const Term& term) { return replace(term); });
  }
  /// Called before the chain is kept. Does the same as `follow` if the chain is long. Columns to
  /// which the chain is added then need not replace these edges again, and many terms cancel.
  std::optional<Term> settle(const Term& pivot) {
    constexpr std::size_t few = 32;
    return is_cycle_ || size() < few ? pivot : follow(pivot, size());
  }
  std::size_t size() const { return heap_.size(); }
  /// The terms of the chain, from young to old. Each edge occurs once.
  std::span<const Term> consolidate() { return heap_.consolidate(); }

 private:
  using Terms = std::pmr::vector<Term>;

  // Replaces an edge that has been removed. The replacement is the rest of the boundary of the
  // square with which the edge is paired inside its star. @return true if this part of the grid
  // sees such a square.
  bool replace(const Term& term) {
    count(1);
    if (const Term* const next = heap_.next()) expect_star(*next);
    if (!grid_.sees(term.cell.voxel())) return false;
    const std::uint32_t u = grid_.here(term.cell.voxel());
    const StarTables& tables = grid_.tables(u);
    const int edge = tables.edge_order().at(term.cell.rank());
    const int s = tables.square_of(grid_.star(u), edge);
    if (s < 0 || !grid_.sees_square(u, s)) return false;
    const auto [first, second] = kEdgesOfSquare[s];
    const int incidence =
        edge == second ? -kSquares[s][axis_of_edge(first)] : kSquares[s][axis_of_edge(second)];
    const Element scale = field_.negate(times(term.coefficient(), incidence));
    heap_.add([&](Terms& terms) { append_boundary(u, s, scale, edge, terms); });
    return true;
  }
  void count(std::size_t steps) {
    constexpr std::size_t many = 64;
    if ((steps_ += steps) < many) return;
    steps_ = 0;
    context_.poll();
    grid_.tidy();
  }
  void expect_star(const Term& term) const {
    const std::uint64_t voxel = term.cell.voxel();
    if (grid_.sees(voxel)) grid_.expect_star(grid_.here(voxel));
  }
  Element times(Element scale, int sign) const { return sign > 0 ? scale : field_.negate(scale); }

  // Appends an edge of a star unless it kills the voxel or a component.
  void append_in_star(std::uint32_t v, int edge, Element coefficient, Terms& terms) {
    const std::uint32_t star = grid_.star(v);
    const StarTables& tables = grid_.tables(v);
    if (tables.arrow(star) == edge || (star & tables.taken_mark(edge)) != 0) return;
    terms.emplace_back(
        LoopEdge::of(grid_.value(v), grid_.in_whole(v), tables.edge_order().rank(edge)),
        coefficient);
  }
  // Appends `scale` times the boundary of a square. Leaves out the edge `skip` of its voxel, unless
  // `skip` is negative. Incidences are as in ph/detail/complex/cubical_cells.hpp.
  void append_boundary(std::uint32_t v, int square, Element scale, int skip, Terms& terms) {
    const auto [first, second] = kEdgesOfSquare[square];
    const int a = axis_of_edge(first), b = axis_of_edge(second);
    const int at = kSquares[square][a], bt = kSquares[square][b];  // directions of the square
    if (second != skip) append_in_star(v, second, times(scale, -at), terms);
    if (first != skip) append_in_star(v, first, times(scale, bt), terms);
    const std::uint32_t over_a = grid_.step(v, a, at), over_b = grid_.step(v, b, bt);
    append_far(over_a, over_b, a, at, b, bt, times(scale, at), times(scale, -bt), terms);
  }
  // Appends the two edges of a square that do not touch its voxel.
  void append_far(std::uint32_t over_a, std::uint32_t over_b, int a, int at, int b, int bt,
                  Element along_b, Element along_a, Terms& terms) {
    std::uint32_t corner = StarGrid::kOutside;
    if (over_a != StarGrid::kOutside)
      corner = grid_.step(over_a, b, bt);
    else if (over_b != StarGrid::kOutside)
      corner = grid_.step(over_b, a, at);
    append_between(over_a, corner, b, bt, along_b, terms);
    append_between(over_b, corner, a, at, along_a, terms);
  }
  // Appends the edge from u to w, which is one step along an axis. Either end may be kOutside.
  void append_between(std::uint32_t u, std::uint32_t w, int axis, int sign, Element coefficient,
                      Terms& terms) {
    Direction d{};
    d[axis] = sign;
    if (u != StarGrid::kOutside && grid_.enters(u) && (grid_.star(u) & star_bit(d)) != 0) {
      append_in_star(u, number_of(d), coefficient, terms);
      return;
    }
    d[axis] = -sign;
    if (w != StarGrid::kOutside && grid_.enters(w))
      append_in_star(w, number_of(d), coefficient, terms);
  }

  const Stars& grid_;
  const K& field_;
  const RunContext& context_;
  const bool is_cycle_;
  ChainHeap<K, Term, &LoopEdge::precedes> heap_;
  std::size_t steps_ = 0;  // the number of steps since the stop token was last polled
};

}  // namespace ph::cubical
