// SPDX-License-Identifier: MIT
#include "alpha/intervals/edges.hpp"

#include <algorithm>
#include <atomic>

#include "alpha/intervals/places.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/error.hpp"

namespace ph::alpha {
namespace {

using std::uint32_t;

/// An edge of a cell as its smaller vertex knows it.
struct Slot {
  uint32_t other;  // its larger vertex
  uint32_t code;   // 8 * cell + edge
};

/// The slots of a vertex, those of one edge side by side. @return how many edges there are.
uint32_t sort_slots(std::span<Slot> slots) {
  std::ranges::sort(slots, [](const Slot& a, const Slot& b) {
    return a.other != b.other ? a.other < b.other : a.code < b.code;
  });
  uint32_t count = 0;
  for (std::size_t i = 0; i < slots.size(); ++i)
    count += i == 0 || slots[i].other != slots[i - 1].other ? 1 : 0;
  return count;
}

}  // namespace

NumberedEdges number_edges(const Triangulation& triangulation, std::size_t sites,
                           const RunContext& context) {
  std::pmr::memory_resource* const memory = &context.memory;
  NumberedEdges edges(memory);
  const auto& cells = triangulation.cells;
  constexpr std::size_t most = std::size_t{1} << 29;
  if (cells.size() >= most)
    throw Error(ErrorKind::resource, "alpha complex: found 2^29 tetrahedra or more");
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
    for (unsigned e = 6; e-- > 0;) {
      const auto& ends = kEdgeEnds[e];
      slots[--begin[cells[t][ends[0]]]] = {cells[t][ends[1]], static_cast<uint32_t>(8 * t + e)};
    }

  constexpr std::size_t piece = 1 << 12;
  const auto slots_of = [&](std::size_t v) {
    const std::size_t end = v + 1 < begin.size() ? begin[v + 1] : slots.size();
    return std::span(slots).subspan(begin[v], end - begin[v]);
  };
  std::pmr::vector<uint32_t> first((sites + piece - 1) / piece + 1, 0, memory);
  for_each_piece("edges", sites, piece, context, [&](std::size_t from, std::size_t to) {
    uint32_t count = 0;
    for (std::size_t v = from; v < to; ++v) count += sort_slots(slots_of(v));
    first[from / piece] = count;
  });
  sum = 0;
  for (uint32_t& f : first) sum += std::exchange(f, sum);
  edges.ends.resize(sum);
  for_each_piece("edges", sites, piece, context, [&](std::size_t from, std::size_t to) {
    uint32_t next = first[from / piece];
    for (std::size_t v = from; v < to; ++v) {
      uint32_t before = kNone;
      for (const Slot& slot : slots_of(v)) {
        if (slot.other != before) edges.ends[next++] = {static_cast<uint32_t>(v), slot.other};
        before = slot.other;
        edges.of_cell[slot.code >> 3][slot.code & 7] = next - 1;
      }
    }
  });
  return edges;
}

}  // namespace ph::alpha
