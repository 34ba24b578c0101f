// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "libph/src/alpha/cgal/kernel.hpp"
#include "libph/src/alpha/triangulation/triangulation.hpp"
#include "ph/error.hpp"

namespace ph::alpha {

/// Inserts all sites. The search for the place of a site starts near the previously inserted site.
/// @param insert inserts one site: it is called with the site and a place at which the search
/// starts, and returns the place at which the search for the next site starts.
/// @param bytes returns the number of bytes that CGAL holds. These bytes must be claimed, because
/// CGAL does not allocate from the budget.
template <class Start, class Insert, class Bytes>
void insert_sites(const Sites& sites, const RunContext& context, MemoryClaim& claim,
                  Insert&& insert, Bytes&& bytes) {
  Ticker ticker(context, "Delaunay triangulation", sites.size());
  Start start{};
  constexpr std::size_t often = 256;
  std::size_t inserted = 0;
  for (const std::uint32_t site : insertion_order(sites, &context.memory)) {
    start = insert(site, start);
    if (++inserted % often == 0) claim.grow_to(bytes());
    ticker.tick();
  }
}

/// Sorts the vertices of a cell in ascending order, where missing vertices (kNone) come last, and
/// reorders the cells across its facets in the same way. The function has no branches, because all
/// orders are equally likely and a processor would often mispredict a branch. @return true if the
/// permutation is odd.
inline bool sort_cell(std::array<std::uint32_t, 4>& vertices,
                      std::array<std::uint32_t, 4>& across) {
  std::array<std::uint64_t, 4> both;
  for (std::size_t k = 0; k < 4; ++k) both[k] = std::uint64_t{vertices[k]} << 32 | across[k];
  bool is_odd = false;
  const auto order = [&](std::size_t i, std::size_t k) {
    const std::uint64_t a = both[i], b = both[k];
    const bool swaps = a >> 32 > b >> 32;
    both[i] = swaps ? b : a;
    both[k] = swaps ? a : b;
    is_odd = is_odd != swaps;
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
  for (std::size_t k = 0; k < 4; ++k) {
    vertices[k] = static_cast<std::uint32_t>(both[k] >> 32);
    across[k] = static_cast<std::uint32_t>(both[k]);
  }
  return is_odd;
}

/// For each facet of each cell, replaces the number of the cell on the other side by the name that
/// the facet has in that cell.
inline void name_facets(Triangulation& result) {
  // This bit marks an entry that was already replaced when the first of the two cells was visited.
  constexpr std::uint32_t named = std::uint32_t{1} << 31;
  auto& across = result.across;
  for (std::uint32_t t = 0; t < across.size(); ++t)
    for (std::uint32_t k = 0; k < 4; ++k) {
      std::uint32_t& other = across[t][k];
      if (other == kNone) continue;
      if ((other & named) != 0) {
        other &= ~named;
        continue;
      }
      auto& back = across[other];
      const std::uint32_t place =
          (back[1] == t ? 1U : 0U) + (back[2] == t ? 2U : 0U) + (back[3] == t ? 3U : 0U);
      back[place] = named | (4 * t + k);
      other = 4 * other + place;
    }
}

/// Copies the cells of a CGAL triangulation, sorted by their smallest vertices, so that cells near
/// each other in space are near in memory.
/// @tparam Handle a handle of a cell. The function overwrites info() of the cells; info() of a
/// vertex is its site.
/// @param for_each_cell calls a function for each cell, with its handle and with true if the cell
/// is finite.
template <class Handle, class ForEachCell>
void copy_cells(Triangulation& result, std::size_t sites, ForEachCell&& for_each_cell,
                const RunContext& context) {
  const int dim = result.dim;
  const auto smallest = [dim](Handle c) {
    std::uint32_t least = c->vertex(0)->info();
    for (int k = 1; k <= dim; ++k) least = std::min(least, c->vertex(k)->info());
    return least;
  };
  // This counting sort orders the finite cells by their smallest vertex. The info() of infinite
  // cells is kNone.
  std::pmr::vector<std::uint32_t> next(sites + 1, 0, &context.memory);
  std::size_t count = 0;
  for_each_cell([&](Handle c, auto&& is_finite) {
    c->info() = kNone;
    if (!is_finite()) return;
    c->info() = smallest(c);
    ++next[c->info()];
    ++count;
  });
  constexpr std::size_t most = std::size_t{1} << 29;
  if (count >= most)
    throw Error(ErrorKind::resource,
                "Delaunay triangulation: found 2^29 cells or more, expected fewer; use fewer "
                "points");
  context.poll();
  result.cells.resize(count);
  result.across.resize(count);
  result.is_reversed.resize(count);
  std::uint32_t sum = 0;
  for (std::uint32_t& n : next) sum += std::exchange(n, sum);
  for_each_cell([&](Handle c, auto&&) {
    if (c->info() != kNone) c->info() = next[c->info()]++;
  });
  context.poll();
  for_each_cell([&](Handle c, auto&&) {
    const std::uint32_t t = c->info();
    if (t == kNone) return;
    auto &vertices = result.cells[t], &across = result.across[t];
    vertices.fill(kNone);
    across.fill(kNone);
    for (int k = 0; k <= dim; ++k) {
      vertices[static_cast<std::size_t>(k)] = c->vertex(k)->info();
      across[static_cast<std::size_t>(k)] = c->neighbor(k)->info();
    }
    result.is_reversed[t] = sort_cell(vertices, across);
  });
  context.poll();
  name_facets(result);
}

/// Copies the edges between neighbouring collinear sites as cells of dimension 1.
template <class ForEachEdge>
void copy_edges(Triangulation& result, ForEachEdge&& for_each_edge) {
  for_each_edge([&](std::uint32_t u, std::uint32_t v) {
    result.cells.push_back({std::min(u, v), std::max(u, v), kNone, kNone});
  });
  std::sort(result.cells.begin(), result.cells.end());
}

}  // namespace ph::alpha
