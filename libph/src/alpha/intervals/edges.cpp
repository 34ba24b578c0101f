// SPDX-License-Identifier: MIT
#include "libph/src/alpha/intervals/edges.hpp"

#include <algorithm>
#include <vector>

#include "ph/detail/core/parallel.hpp"
#include "ph/error.hpp"

namespace ph::alpha {
namespace {

using std::uint32_t;

/// An edge found in a cell: the upper 32 bits hold the larger end of the edge, and the lower 32
/// bits hold 8 · cell + the number of the edge in this cell.
using Found = std::uint64_t;
uint32_t larger_end(Found found) { return static_cast<uint32_t>(found >> 32); }
std::size_t cell_of(Found found) { return static_cast<uint32_t>(found) >> 3; }
unsigned edge_of(Found found) { return static_cast<unsigned>(found & 7); }

/// Calls a function with each edge of a cell. Leaves out an edge if the neighbour across one of the
/// cell's two facets at that edge has a smaller number. Of the cells around an edge, the first
/// always reports the edge, and the others rarely do.
template <class Use>
void for_each_first(const Triangulation& triangulation, std::size_t cell, Use&& use) {
  // A bit for each facet whose other side is a later cell, no cell or the cell itself.
  unsigned later = 0;
  for (unsigned k = 0; k < 4; ++k)
    later |= triangulation.across[cell][k] >= 4 * cell ? 1U << k : 0U;
  for (unsigned e = 0; e < 6; ++e) {
    const unsigned beside = 0b1111U & ~(1U << kEdgeEnds[e][0]) & ~(1U << kEdgeEnds[e][1]);
    if ((later & beside) == beside) use(e);
  }
}

/// In a periodic space, the places of the two ends of a cell's edge.
NumberedEdges::Ends frame_of(const Images& images, std::size_t cell, unsigned edge) {
  const auto& places = images.of_cell[cell];
  return {places[kEdgeEnds[edge][0]], places[kEdgeEnds[edge][1]]};
}
/// The translation from the smaller end of an edge to the larger one. Two edges with the same ends
/// are equal if these translations are equal.
Translation translation_of(const Images& images, const NumberedEdges::Ends& frame) {
  return images.translation[frame[1]] - images.translation[frame[0]];
}

/// Removes duplicates from the edges with the same smaller end. @return the number of edges left.
std::size_t keep_first(std::span<Found> of_vertex, const Images* images) {
  std::ranges::sort(of_vertex);
  std::size_t kept = 0;
  for (const Found found : of_vertex) {
    const auto is_same = [&](Found other) {
      // mutant: alpha-same-edge
      return images == nullptr ||
             translation_of(*images, frame_of(*images, cell_of(other), edge_of(other))) ==
                 translation_of(*images, frame_of(*images, cell_of(found), edge_of(found)));
    };
    bool is_new = true;
    for (std::size_t i = kept; is_new && i-- > 0 && larger_end(of_vertex[i]) == larger_end(found);)
      is_new = !is_same(of_vertex[i]);
    if (is_new) of_vertex[kept++] = found;  // mutant: alpha-new-edge
  }
  return kept;
}

void number_edges_of_cells(const Triangulation& triangulation, const Images& images,
                           NumberedEdges& edges, const RunContext& context) {
  edges.of_cell.resize(triangulation.size());
  constexpr std::size_t piece = 1 << 13;
  for_each_piece(
      "edges", triangulation.size(), piece, context, [&](std::size_t from, std::size_t to) {
        for (std::size_t t = from; t < to; ++t)
          for (unsigned e = 0; e < 6; ++e) {
            const auto& cell = triangulation.cells[t];
            uint32_t number = edges.with_ends(cell[kEdgeEnds[e][0]], cell[kEdgeEnds[e][1]]);
            const Translation wanted = translation_of(images, frame_of(images, t, e));
            while (translation_of(images, images.of_edge[number]) != wanted) ++number;
            edges.of_cell[t][e] = number;
          }
      });
}

}  // namespace

NumberedEdges number_edges(const Triangulation& triangulation, std::size_t sites, Images* images,
                           const RunContext& context) {
  std::pmr::memory_resource* const memory = &context.memory;
  const auto& cells = triangulation.cells;
  if (6 * cells.size() >= kNone)
    throw Error(ErrorKind::resource, "alpha complex: found too many edges of tetrahedra");

  // Collects the edges, sorted by smaller vertex and with some duplicates.
  std::pmr::vector<uint32_t> begin(sites + 1, 0, memory);
  for (std::size_t t = 0; t < cells.size(); ++t)
    for_each_first(triangulation, t, [&](unsigned e) { ++begin[cells[t][kEdgeEnds[e][0]]]; });
  uint32_t sum = 0;
  for (uint32_t& b : begin) b = sum += b;
  context.poll();
  RawVector<Found> found(sum, memory);
  for (std::size_t t = cells.size(); t-- > 0;)
    for_each_first(triangulation, t, [&](unsigned e) {
      found[--begin[cells[t][kEdgeEnds[e][0]]]] =
          Found{cells[t][kEdgeEnds[e][1]]} << 32 | (8 * t + e);
    });
  context.poll();

  NumberedEdges edges(memory);
  edges.begin.assign(sites + 1, 0);
  constexpr std::size_t piece = 1 << 13;
  for_each_piece("edges", sites, piece, context, [&](std::size_t from, std::size_t to) {
    for (std::size_t v = from; v < to; ++v) {
      const auto of_vertex = std::span(found).subspan(begin[v], begin[v + 1] - begin[v]);
      edges.begin[v] = static_cast<uint32_t>(keep_first(of_vertex, images));
    }
  });
  sum = 0;
  for (uint32_t& b : edges.begin) sum += std::exchange(b, sum);
  edges.ends.resize(sum);
  if (images != nullptr) images->of_edge.resize(sum);
  for_each_piece("edges", sites, piece, context, [&](std::size_t from, std::size_t to) {
    for (std::size_t v = from; v < to; ++v)
      for (uint32_t e = edges.begin[v]; e < edges.begin[v + 1]; ++e) {
        const Found of_edge = found[begin[v] + e - edges.begin[v]];
        edges.ends[e] = {static_cast<uint32_t>(v), larger_end(of_edge)};
        if (images != nullptr)
          images->of_edge[e] = frame_of(*images, cell_of(of_edge), edge_of(of_edge));
      }
  });
  if (images != nullptr) number_edges_of_cells(triangulation, *images, edges, context);
  return edges;
}

}  // namespace ph::alpha
