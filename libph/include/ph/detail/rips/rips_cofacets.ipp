// SPDX-License-Identifier: MIT
#pragma once
// Cofacets in Rips filtrations. Included by rips_filtration.hpp.

namespace ph {

template <RipsLayout Layout, int Words>
template <class Visit>
void RipsFiltration<Layout, Words>::for_each_cofacet_within(int dim, const Cell& cell, Key first,
                                                            Key last, Visit&& visit) const {
  if (cell.key > last) return;
  // Cofacets are visited by ascending new vertex w, and therefore in the order of their vertices:
  // among cofacets of equal key, the first one is the oldest. `slot` is the place of w among the
  // vertices: the vertices in lower slots are smaller.
  const int count = dim + 1;
  std::array<std::uint32_t, kMostVertices + 1> vertices;
  for (int slot = 0; slot < count; ++slot)
    vertices[static_cast<std::size_t>(slot)] = vertex(cell, slot);
  vertices[static_cast<std::size_t>(count)] = static_cast<std::uint32_t>(graph_.size());

  const RipsAdjacency& adjacent = adjacency();
  int slot = 0;
  Vertices frame;  // the cofacet without w
  const auto open_slot = [&] {
    frame = (cell.vertices >> (slot * bits_)) << ((slot + 1) * bits_) | below(cell.vertices, slot);
  };
  open_slot();
  const auto emit = [&](std::uint32_t w, Key key) {
    return visit(Cell{key, frame | Vertices(w) << (slot * bits_)}, slot % 2 == 0 ? 1 : -1);
  };

  if (has_matrix()) {
    std::array<const Key*, kMostVertices> rows;
    for (int i = 0; i < count; ++i)
      rows[static_cast<std::size_t>(i)] = adjacent.row(vertices[static_cast<std::size_t>(i)]);
    const std::span<const Key* const> used(rows.data(), static_cast<std::size_t>(count));
    const auto size = static_cast<std::uint32_t>(graph_.size());
    // mutant: cofacet-blocks
    for (std::uint32_t begin = 0; begin < size; begin += KeyBlock::kSize) {
      const KeyBlock keys(used, begin, std::min(size - begin, KeyBlock::kSize), cell.key, first,
                          std::min(last, RipsAdjacency::kNever - 1));
      for (auto rest = keys.within(); rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(rest));
        if (vertices[static_cast<std::size_t>(slot)] < begin + i) {
          while (vertices[static_cast<std::size_t>(slot)] < begin + i) ++slot;
          open_slot();
        }
        if (!emit(begin + i, keys[i])) return;
      }
    }
  } else {
    std::array<std::span<const Neighbour>, kMostVertices> lists;
    for (int i = 0; i < count; ++i) {
      lists[static_cast<std::size_t>(i)] =
          adjacent.neighbours(vertices[static_cast<std::size_t>(i)]);
      // The shortest list leads.
      if (lists[static_cast<std::size_t>(i)].size() < lists[0].size())
        std::swap(lists[static_cast<std::size_t>(i)], lists[0]);
    }
    for (const Neighbour& lead : lists[0]) {
      Key key = std::max(cell.key, lead.key);
      bool common = true;
      for (int i = 1; common && i < count; ++i) {
        auto& list = lists[static_cast<std::size_t>(i)];
        while (!list.empty() && list.front().vertex < lead.vertex) list = list.subspan(1);
        if (list.empty()) return;
        common = list.front().vertex == lead.vertex;
        if (common) key = std::max(key, list.front().key);
      }
      if (!common || key < first || key > last) continue;  // mutant: cofacet-range-list
      if (vertices[static_cast<std::size_t>(slot)] < lead.vertex) {
        while (vertices[static_cast<std::size_t>(slot)] < lead.vertex) ++slot;
        open_slot();
      }
      if (!emit(lead.vertex, key)) return;
    }
  }
}

template <RipsLayout Layout, int Words>
auto RipsFiltration<Layout, Words>::horizon(Key key) const -> Key {
  // The share was chosen by measurement, see docs/explanation/engines/cohomology.md. Without a
  // matrix, there is no limit: merging the lists of neighbours again would take more time than a
  // limit saves.
  constexpr Key share = 16;
  constexpr Key no_limit = std::numeric_limits<Key>::max();
  if (!has_matrix()) return no_limit;
  const Key step = key / share + 1;
  return key >= graph_.edge_count() || graph_.edge_count() - key <= step ? no_limit : key + step;
}

}  // namespace ph
