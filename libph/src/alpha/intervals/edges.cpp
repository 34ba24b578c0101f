// SPDX-License-Identifier: MIT
#include "alpha/intervals/edges.hpp"

#include <algorithm>
#include <vector>

#include "alpha/intervals/places.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/error.hpp"

namespace ph::alpha {
namespace {

using std::uint32_t;

/// The edges of a cell that have one smaller vertex: 8 · cell + edge.
using Slot = uint32_t;

/// Where an edge was met before: by its larger vertex, the smaller one and a number.
class MetEdges {
 public:
  MetEdges(std::size_t sites, std::pmr::memory_resource* memory)
      : met_(sites, ~std::uint64_t{0}, memory) {}
  /// @param next the number of a new edge.
  uint32_t number(uint32_t smaller, uint32_t larger, uint32_t next) {
    std::uint64_t& met = met_[larger];
    if (met >> 32 != smaller) met = std::uint64_t{smaller} << 32 | next;
    return static_cast<uint32_t>(met);
  }

 private:
  std::pmr::vector<std::uint64_t> met_;
};

}  // namespace

NumberedEdges number_edges(const Triangulation& triangulation, std::size_t sites,
                           const RunContext& context) {
  std::pmr::memory_resource* const memory = &context.memory;
  NumberedEdges edges(memory);
  const auto& cells = triangulation.cells;
  edges.of_cell.resize(cells.size());

  // Buckets by smaller vertex.
  std::pmr::vector<uint32_t> begin(sites + 1, 0, memory);
  for (const auto& cell : cells)
    for (const auto& ends : kEdgeEnds) ++begin[cell[ends[0]]];
  if (6 * cells.size() >= kNone)
    throw Error(ErrorKind::resource, "alpha complex: found too many edges of tetrahedra");
  uint32_t sum = 0;
  for (uint32_t& b : begin) b = sum += b;
  context.poll();
  RawVector<Slot> slots(6 * cells.size(), memory);
  for (std::size_t t = cells.size(); t-- > 0;)
    for (unsigned e = 6; e-- > 0;)
      slots[--begin[cells[t][kEdgeEnds[e][0]]]] = static_cast<Slot>(8 * t + e);

  // By pieces of vertices: numbers from 0, then from where the piece begins.
  const std::size_t threads = thread_count(context);
  const std::size_t piece = threads == 1 ? sites : std::max<std::size_t>(1, sites / (4 * threads));
  const auto slots_of = [&](std::size_t from, std::size_t to) {
    const std::size_t end = to < sites ? begin[to] : slots.size();
    return std::span(slots).subspan(begin[from], end - begin[from]);
  };
  const std::size_t pieces = (sites + piece - 1) / piece;
  std::pmr::vector<std::pmr::vector<std::array<uint32_t, 2>>> ends(pieces, memory);
  for_each_piece("edges", sites, piece, context, [&](std::size_t from, std::size_t to) {
    auto& of_piece = ends[from / piece];
    of_piece.reserve(8 * (to - from));
    MetEdges met(sites, memory);
    for (std::size_t v = from; v < to; ++v) {
      const auto smaller = static_cast<uint32_t>(v);
      for (const Slot slot : slots_of(v, v + 1)) {
        const uint32_t larger = cells[slot >> 3][kEdgeEnds[slot & 7][1]];
        const auto next = static_cast<uint32_t>(of_piece.size());
        const uint32_t number = met.number(smaller, larger, next);
        if (number == next) of_piece.push_back({smaller, larger});
        edges.of_cell[slot >> 3][slot & 7] = number;
      }
    }
  });
  std::pmr::vector<uint32_t> first(pieces, 0, memory);
  sum = 0;
  for (std::size_t i = 0; i < pieces; ++i) {
    first[i] = sum;
    sum += static_cast<uint32_t>(ends[i].size());
  }
  edges.ends.resize(sum);
  for_each_piece("edges", sites, piece, context, [&](std::size_t from, std::size_t to) {
    auto& of_piece = ends[from / piece];
    std::ranges::copy(of_piece, edges.ends.begin() + first[from / piece]);
    of_piece = std::pmr::vector<std::array<uint32_t, 2>>(memory);
    if (first[from / piece] == 0) return;
    for (const Slot slot : slots_of(from, to))
      edges.of_cell[slot >> 3][slot & 7] += first[from / piece];
  });
  return edges;
}

}  // namespace ph::alpha
