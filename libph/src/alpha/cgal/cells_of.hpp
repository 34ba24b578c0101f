// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "alpha/cgal/kernel.hpp"
#include "alpha/triangulation/triangulation.hpp"
#include "ph/error.hpp"

namespace ph::alpha {

/// Inserts all sites, each beside the one before.
/// @param insert called with (site, where to begin): gives where the next one is to begin.
template <class Start, class Insert>
void insert_sites(std::size_t sites, const RunContext& context, Insert&& insert) {
  Ticker ticker(context, "Delaunay triangulation", sites);
  Start start{};
  for (const std::uint32_t site : insertion_order(sites, &context.memory)) {
    start = insert(site, start);
    ticker.tick();
  }
}

/// Sorts the vertices of a cell, and with them what lies across. @return whether that is an odd
/// permutation.
template <class T>
bool sort_cell(std::array<std::uint32_t, 4>& vertices, std::array<T, 4>& across, int dim) {
  bool is_odd = false;
  for (int i = 1; i <= dim; ++i)
    for (int k = i; k > 0; --k) {
      const auto at = static_cast<std::size_t>(k);
      if (vertices[at - 1] < vertices[at]) break;
      std::swap(vertices[at - 1], vertices[at]);
      std::swap(across[at - 1], across[at]);
      is_odd = !is_odd;
    }
  return is_odd;
}

/// Copies the cells of a triangulation of CGAL in the order of their smallest vertices, which is an
/// order in space.
/// @param for_each_cell calls a function with the handle of each finite cell. @tparam Handle to a
/// cell, whose info() is free to use; that of a vertex is its site. That of an infinite cell is
/// kNone.
template <class Handle, class ForEachCell>
void copy_cells(Triangulation& result, std::size_t sites, std::size_t count,
                ForEachCell&& for_each_cell, const RunContext& context) {
  constexpr std::size_t most = std::size_t{1} << 30;
  if (count >= most)
    throw Error(ErrorKind::resource, "Delaunay triangulation: found 2^30 cells or more");
  const int dim = result.dim;
  result.cells.resize(count);
  result.across.resize(count);
  result.is_reversed.resize(count);
  const auto smallest = [dim](Handle c) {
    std::uint32_t least = c->vertex(0)->info();
    for (int k = 1; k <= dim; ++k) least = std::min(least, c->vertex(k)->info());
    return least;
  };
  std::pmr::vector<std::uint32_t> next(sites + 1, 0, &context.memory);
  for_each_cell([&](Handle c) { ++next[smallest(c)]; });
  std::uint32_t sum = 0;
  for (std::uint32_t& n : next) sum += std::exchange(n, sum);
  for_each_cell([&](Handle c) { c->info() = next[smallest(c)]++; });
  context.poll();
  // The facets of a cell in the order of CGAL's vertices, then in that of the sorted ones.
  std::pmr::vector<std::array<std::uint8_t, 4>> place(count, &context.memory);
  for_each_cell([&](Handle c) {
    const std::uint32_t t = c->info();
    auto& vertices = result.cells[t];
    vertices.fill(kNone);
    std::array<std::uint8_t, 4> from{0, 1, 2, 3};
    for (int k = 0; k <= dim; ++k) vertices[static_cast<std::size_t>(k)] = c->vertex(k)->info();
    result.is_reversed[t] = sort_cell(vertices, from, dim);
    for (std::uint8_t k = 0; k < 4; ++k) place[t][from[k]] = k;
  });
  context.poll();
  for_each_cell([&](Handle c) {
    const std::uint32_t t = c->info();
    auto& across = result.across[t];
    across.fill(kNone);
    for (int k = 0; k <= dim; ++k) {
      const Handle other = c->neighbor(k);
      if (other->info() == kNone) continue;
      const auto back = static_cast<std::size_t>(other->index(c));
      across[place[t][static_cast<std::size_t>(k)]] =
          4 * other->info() + place[other->info()][back];
    }
  });
}

/// The edges between neighbours of collinear sites as cells of dimension 1.
template <class ForEachEdge>
void copy_edges(Triangulation& result, ForEachEdge&& for_each_edge) {
  for_each_edge([&](std::uint32_t u, std::uint32_t v) {
    result.cells.push_back({std::min(u, v), std::max(u, v), kNone, kNone});
  });
  std::sort(result.cells.begin(), result.cells.end());
}

}  // namespace ph::alpha
