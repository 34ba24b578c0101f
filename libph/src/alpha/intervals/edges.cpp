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

/// The edges of a piece of the vertices, by number from 0.
struct PieceOfEdges {
  using Ends = std::array<uint32_t, 2>;
  using allocator_type = std::pmr::polymorphic_allocator<>;
  explicit PieceOfEdges(allocator_type memory) : ends(memory), frames(memory) {}
  PieceOfEdges(PieceOfEdges&& other, allocator_type memory)
      : ends(std::move(other.ends), memory), frames(std::move(other.frames), memory) {}

  /// The edge of which one is a translate: most likely `candidate`, else one from `first` on; the
  /// next number if there is none.
  uint32_t translate_of(const Ends& frame, uint32_t larger, uint32_t candidate, uint32_t first,
                        const Images& images) const {
    const auto translation = [&](const Ends& e) {
      return images.translation[e[1]] - images.translation[e[0]];
    };
    if (translation(frames[candidate]) == translation(frame)) return candidate;
    auto number = static_cast<uint32_t>(ends.size());
    for (uint32_t e = first; e < ends.size(); ++e)
      if (ends[e][1] == larger && translation(frames[e]) == translation(frame)) number = e;
    return number;
  }

  std::pmr::vector<Ends> ends;
  std::pmr::vector<Ends> frames;  // of a periodic space: where they are
};

/// Where an edge was met before: by its larger vertex, the smaller one and a number.
class MetEdges {
 public:
  MetEdges(std::size_t sites, std::pmr::memory_resource* memory)
      : met_(sites, ~std::uint64_t{0}, memory) {}
  /// @param next the number of a new edge.
  /// @param find called with the number of one that has the same ends: gives that of this edge.
  template <class Find>
  uint32_t number(uint32_t smaller, uint32_t larger, uint32_t next, Find&& find) {
    std::uint64_t& met = met_[larger];
    const uint32_t number = met >> 32 == smaller ? find(static_cast<uint32_t>(met)) : next;
    met = std::uint64_t{smaller} << 32 | number;
    return number;
  }

 private:
  std::pmr::vector<std::uint64_t> met_;
};

}  // namespace

NumberedEdges number_edges(const Triangulation& triangulation, std::size_t sites, Images* images,
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
  std::pmr::vector<PieceOfEdges> of_pieces(pieces, memory);
  for_each_piece("edges", sites, piece, context, [&](std::size_t from, std::size_t to) {
    PieceOfEdges& of_piece = of_pieces[from / piece];
    of_piece.ends.reserve(8 * (to - from));
    MetEdges met(sites, memory);
    for (std::size_t v = from; v < to; ++v) {
      const auto smaller = static_cast<uint32_t>(v);
      const auto first = static_cast<uint32_t>(of_piece.ends.size());
      for (const Slot slot : slots_of(v, v + 1)) {
        const auto& places = kEdgeEnds[slot & 7];
        const uint32_t larger = cells[slot >> 3][places[1]];
        const auto next = static_cast<uint32_t>(of_piece.ends.size());
        std::array<uint32_t, 2> frame{};
        if (images != nullptr) {
          const auto& cell = images->of_cell[slot >> 3];
          frame = {cell[places[0]], cell[places[1]]};
        }
        const uint32_t number = met.number(smaller, larger, next, [&](uint32_t candidate) {
          return images == nullptr
                     ? candidate
                     : of_piece.translate_of(frame, larger, candidate, first, *images);
        });
        edges.of_cell[slot >> 3][slot & 7] = number;
        if (number != next) continue;
        of_piece.ends.push_back({smaller, larger});
        if (images != nullptr) of_piece.frames.push_back(frame);
      }
    }
  });
  std::pmr::vector<uint32_t> first(pieces, 0, memory);
  sum = 0;
  for (std::size_t i = 0; i < pieces; ++i) {
    first[i] = sum;
    sum += static_cast<uint32_t>(of_pieces[i].ends.size());
  }
  edges.ends.resize(sum);
  if (images != nullptr) images->of_edge.resize(sum);
  for_each_piece("edges", sites, piece, context, [&](std::size_t from, std::size_t to) {
    PieceOfEdges& of_piece = of_pieces[from / piece];
    std::ranges::copy(of_piece.ends, edges.ends.begin() + first[from / piece]);
    if (images != nullptr)
      std::ranges::copy(of_piece.frames, images->of_edge.begin() + first[from / piece]);
    of_piece = PieceOfEdges(memory);
    if (first[from / piece] == 0) return;
    for (const Slot slot : slots_of(from, to))
      edges.of_cell[slot >> 3][slot & 7] += first[from / piece];
  });
  return edges;
}

}  // namespace ph::alpha
