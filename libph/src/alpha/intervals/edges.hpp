// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>

#include "libph/src/alpha/intervals/places.hpp"
#include "libph/src/alpha/periodic/images.hpp"
#include "libph/src/alpha/triangulation/triangulation.hpp"

namespace ph::alpha {

/// The edges of a triangulation of dimension 3, numbered in the order of their ends. An edge of a
/// cell is looked up by its ends, among the few edges with the same smaller end.
struct NumberedEdges {
  using Ends = std::array<std::uint32_t, 2>;

  explicit NumberedEdges(std::pmr::memory_resource* memory)
      : ends(memory), begin(memory), of_cell(memory) {}

  std::size_t size() const { return ends.size(); }
  /// The edge between the vertices at positions i and k of a cell.
  std::uint32_t between(const Triangulation& triangulation, std::size_t cell, unsigned i,
                        unsigned k) const {
    if (!of_cell.empty()) return of_cell[cell][kEdgeBetween[i][k]];
    const auto& vertices = triangulation.cells[cell];
    return i < k ? with_ends(vertices[i], vertices[k]) : with_ends(vertices[k], vertices[i]);
  }
  /// The edges of a facet; the edge at position i lies opposite the vertex at position i.
  std::array<std::uint32_t, 3> of_facet(const Triangulation& triangulation,
                                        std::uint32_t code) const {
    const auto& places = kFacetPlaces[code & 3];
    if (!of_cell.empty()) {
      const auto& of = of_cell[code >> 2];
      return {of[kEdgeBetween[places[1]][places[2]]], of[kEdgeBetween[places[0]][places[2]]],
              of[kEdgeBetween[places[0]][places[1]]]};
    }
    const auto& vertices = triangulation.cells[code >> 2];
    const std::uint32_t a = vertices[places[0]], b = vertices[places[1]], c = vertices[places[2]];
    const std::uint32_t ab = with_ends(a, b);
    return {with_ends(b, c), to(c, ab + 1, begin[a + 1]), ab};
  }
  /// The first edge with these ends. Preconditions: smaller <= larger, and such an edge exists.
  std::uint32_t with_ends(std::uint32_t smaller, std::uint32_t larger) const {
    return to(larger, begin[smaller], begin[smaller + 1]);
  }

  RawVector<Ends> ends;  ///< in ascending order; both ends of a loop are the same vertex
  /// For each site, the first edge that has the site as its smaller end. The last entry is size().
  std::pmr::vector<std::uint32_t> begin;
  /// For each cell, its edges in the order of kEdgeEnds. The array is empty unless the space is
  /// periodic, because several edges can have the same ends only in a periodic space.
  RawVector<std::array<std::uint32_t, 6>> of_cell;

 private:
  /// The first edge with this larger end in a range of edges with the same smaller end.
  std::uint32_t to(std::uint32_t larger, std::uint32_t first, std::uint32_t last) const {
    constexpr std::uint32_t few = 16;
    while (last - first > few) {
      const std::uint32_t middle = first + (last - first) / 2;
      (ends[middle][1] < larger ? first : last) = middle;  // mutant: alpha-find-edge
    }
    while (ends[first][1] < larger) ++first;
    return first;
  }
};

/// Numbers the edges of n cells in O(n log n). Uses threads.
/// @param images the images of the sites if the space is periodic, otherwise null. The function
/// stores the frames of the edges in these images.
NumberedEdges number_edges(const Triangulation& triangulation, std::size_t sites, Images* images,
                           const RunContext& context);

}  // namespace ph::alpha
