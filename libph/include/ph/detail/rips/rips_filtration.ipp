// SPDX-License-Identifier: MIT
#pragma once
// Apparent pairs of Rips filtrations; see docs/explanation/engines/cohomology.md.
// Included by rips_filtration.hpp.

namespace ph {

// A simplex consists of its longest edge e and a clique of the link of e. Let m be the least vertex
// of the clique. The oldest cofacet of the simplex with an equal key adds the least vertex w of the
// link that is joined to all vertices of the clique. The youngest facet of equal key of this
// cofacet is the simplex if and only if w < m.
template <RipsLayout Layout, int Words>
auto RipsFiltration<Layout, Words>::apparent_cofacet(int dim, const Cell& cell) const
    -> std::optional<Cell> {
  if (dim == 0) return std::nullopt;
  const int slot = first_slot_off_longest(dim, cell);
  const std::uint32_t w = first_common_neighbour(
      dim, cell, kNoSlot,
      slot <= dim ? vertex(cell, slot) : static_cast<std::uint32_t>(vertex_count()));
  if (w == kNoVertex) return std::nullopt;
  int place = 0;
  while (place <= dim && vertex(cell, place) < w) ++place;
  const Vertices frame =
      (cell.vertices >> (place * bits_)) << ((place + 1) * bits_) | below(cell.vertices, place);
  return Cell{cell.key, frame | Vertices(w) << (place * bits_)};
}

// Here the cell is the cofacet of its pair. The facet is the cell without m, provided that m is the
// first vertex that can be added to this facet.
template <RipsLayout Layout, int Words>
auto RipsFiltration<Layout, Words>::apparent_facet(int dim, const Cell& cell) const
    -> std::optional<Cell> {
  if (dim <= 1) return std::nullopt;
  const int slot = first_slot_off_longest(dim, cell);
  if (first_common_neighbour(dim, cell, slot, vertex(cell, slot)) != kNoVertex) return std::nullopt;
  return Cell{cell.key, without(cell.vertices, slot)};
}

template <RipsLayout Layout, int Words>
std::uint32_t RipsFiltration<Layout, Words>::first_common_neighbour(int dim, const Cell& cell,
                                                                    int skipped,
                                                                    std::uint32_t below) const {
  const RipsAdjacency& adjacent = adjacency();
  std::size_t count = 0;
  if (has_matrix()) {
    std::array<const Key*, kMostVertices> rows;
    for (int slot = 0; slot <= dim; ++slot)
      if (slot != skipped) rows[count++] = adjacent.row(vertex(cell, slot));
    for (std::uint32_t w = 0; w < below; ++w) {
      std::size_t i = 0;
      while (i < count && rows[i][w] < cell.key) ++i;
      if (i == count) return w;
    }
  } else {
    // The shortest list leads.
    std::array<std::span<const Neighbour>, kMostVertices> lists;
    for (int slot = 0; slot <= dim; ++slot) {
      if (slot == skipped) continue;
      lists[count] = adjacent.neighbours(vertex(cell, slot));
      if (lists[count].size() < lists[0].size()) std::swap(lists[count], lists[0]);
      ++count;
    }
    for (const Neighbour& lead : lists[0]) {
      if (lead.vertex >= below) break;  // mutant: rips-apparent
      if (lead.key >= cell.key) continue;
      std::size_t i = 1;
      for (; i < count; ++i) {
        auto& list = lists[i];
        while (!list.empty() && list.front().vertex < lead.vertex) list = list.subspan(1);
        if (list.empty()) return kNoVertex;
        if (list.front().vertex != lead.vertex || list.front().key >= cell.key) break;
      }
      if (i == count) return lead.vertex;
    }
  }
  return kNoVertex;
}

/// Lists the cells in no apparent pair, as ApparentFiltration requires.
template <RipsLayout Layout, int Words>
class RipsFiltration<Layout, Words>::UnmatchedCells {
 public:
  /// @param has_rows true if RipsGroups are used; the cells are the same in either case.
  UnmatchedCells(const RipsFiltration& filtration, int dim, bool has_rows)
      : f_(filtration), dim_(dim), candidates_(static_cast<std::size_t>(std::max(dim, 1))) {
    if (has_rows) groups_.emplace(f_.graph_);
  }
  UnmatchedCells(const RipsFiltration& filtration, int dim)
      : UnmatchedCells(filtration, dim, RipsGroups::are_affordable(filtration.graph_)) {}

  template <class Visit, class OnStep>
  void for_each(std::size_t first, std::size_t last, Visit&& visit, OnStep&& on_step) {
    for (std::size_t i = last; i-- > first;) {
      on_step();
      const auto longest = static_cast<std::uint32_t>(i);
      if (!groups_) {
        search(longest, visit, on_step);
      } else if (const bool is_alone = groups_->go_to(longest + 1); dim_ == 1) {
        if (is_alone) visit(f_.edge_cell(longest));
      } else if (!is_alone) {
        const auto visit_clique = [&](std::span<const std::uint32_t> others) {
          visit(f_.over_edge(longest, others));
        };
        groups_->for_each_unmatched(dim_ - 1, visit_clique, on_step);
      }
    }
  }

 private:
  /// Looks at all cells of a group.
  template <class Visit, class OnStep>
  void search(std::uint32_t longest, Visit& visit, OnStep& on_step) {
    if (dim_ == 1) {
      if (const Cell e = f_.edge_cell(longest); !f_.apparent_cofacet(1, e)) visit(e);
      return;
    }
    const FlagEdge& e = f_.graph_.edge(longest + 1);
    auto& link = candidates_[0];
    link.clear();
    f_.smaller_neighbours(e.u, static_cast<std::uint32_t>(f_.vertex_count()), link);
    std::erase_if(link, [&](Neighbour& w) {
      const bool is_in = w.key <= longest && f_.adjacency().key_of(e.v, w.vertex) <= longest;
      w.key = 0;
      return !is_in;
    });
    cells_.clear();
    f_.extend_clique(Cell{}, link, dim_ - 1, longest, candidates_, [&](const Cell& clique) {
      on_step();
      std::array<std::uint32_t, kMostVertices> others;
      const auto size = static_cast<std::size_t>(dim_ - 1);
      for (std::size_t i = 0; i < size; ++i)
        others[i] = f_.vertex(clique, static_cast<int>(size - 1 - i));
      const Cell cell = f_.over_edge(longest, std::span(others).first(size));
      if (!f_.apparent_facet(dim_, cell) && !f_.apparent_cofacet(dim_, cell))
        cells_.push_back(cell);
    });
    std::sort(cells_.begin(), cells_.end(),
              [&](const Cell& a, const Cell& b) { return f_.precedes(b, a); });
    for (const Cell& cell : cells_) visit(cell);
  }

  const RipsFiltration& f_;
  int dim_;
  std::optional<RipsGroups> groups_;
  std::vector<std::vector<Neighbour>> candidates_;
  std::vector<Cell> cells_;
};

}  // namespace ph
