// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/alpha/intervals/edges.hpp"
#include "libph/src/alpha/intervals/places.hpp"
#include "libph/src/alpha/triangulation/triangulation.hpp"

namespace ph::alpha {

/// Values of Edge::up other than the name of a facet.
inline constexpr std::uint32_t kCritical = kNone;  ///< not paired: the edge alone is an interval
/// Paired with a vertex: the edge joins components.
inline constexpr std::uint32_t kJoins = kNone - 1;
inline constexpr std::uint32_t kUnknown = kNone - 2;  ///< the interval of the edge is not known yet

struct Edge {
  double value;
  std::uint32_t up;  ///< the facet with which the edge is paired, or one of the constants above
};

/// A facet that is not paired with any simplex of its interval.
struct CriticalFacet {
  double value = 0;
  std::uint32_t code = 0;  ///< the usual name of the facet
};

/// The vertices of a facet of a cell, ascending; below dimension 3, the last entry is kNone.
inline std::array<std::uint32_t, 3> facet_of(const std::array<std::uint32_t, 4>& cell,
                                             std::uint32_t facet, int dim) {
  const auto& places = kFacetPlaces[facet];
  return {cell[places[0]], cell[places[1]], dim == 3 ? cell[places[2]] : kNone};
}

/// The alpha filtration of a triangulation, with the pairs of its intervals.
///
/// The simplices are divided into intervals [L, U]. An interval consists of the faces of U that
/// contain L, which all have the same alpha value. The smallest sphere of U is empty. L consists of
/// the vertices of U for which the centre of this sphere does not lie beyond the opposite facet
/// (Bauer & Edelsbrunner, The Morse theory of Čech and Delaunay complexes, 2017). Let a be the
/// first vertex of U outside L. Each simplex of the interval without a is paired with the same
/// simplex plus a. If L = U, the interval is a single simplex, which is *critical*.
///
/// Values are squared radii, in the units of the sites. All simplices of an interval have the same
/// value, and no face has a larger value than a coface.
struct AlphaCells {
  explicit AlphaCells(Sites all_sites, std::pmr::memory_resource* memory)
      : sites(std::move(all_sites)),
        hidden(memory),
        triangulation(memory),
        cell_values(memory),
        beyond(memory),
        facets(memory),
        edges(memory),
        edge_states(memory),
        vertex_values(memory),
        vertex_up(memory),
        vertex_facet(memory) {}

  int dim() const { return triangulation.dim; }
  double vertex_value(std::uint32_t v) const {
    return vertex_values.empty() ? 0.0 : vertex_values[v];
  }
  /// True if a facet is paired with the cell that its name belongs to.
  bool is_facet_paired_up(std::uint32_t code) const {
    const unsigned places = beyond[code >> 2];
    return places != 0 && lowest(places) == (code & 3);
  }
  /// True if a facet lies in the interval of the cell that its name belongs to.
  bool belongs_to(std::uint32_t code) const { return (beyond[code >> 2] >> (code & 3) & 1) != 0; }
  std::uint32_t across(std::uint32_t code) const {
    return triangulation.across[code >> 2][code & 3];
  }
  /// In dimension 3: the edge between the vertices at positions i and k of a cell.
  std::uint32_t edge_between(std::size_t cell, unsigned i, unsigned k) const {
    return edges.between(triangulation, cell, i, k);
  }
  /// In dimension 3: the edges of a facet; edge i lies opposite vertex i.
  std::array<std::uint32_t, 3> facet_edges(std::uint32_t code) const {
    return edges.of_facet(triangulation, code);
  }
  /// The vertices of a facet, ascending; below dimension 3, the last entry is kNone.
  std::array<std::uint32_t, 3> facet_vertices(std::uint32_t code) const {
    return facet_of(triangulation.cells[code >> 2], code & 3, dim());
  }

  Sites sites;
  bool is_periodic = false;                ///< true if the triangulation is a Delta-complex
  std::vector<double> period;              ///< as in AlphaOptions; empty if no axis closes up
  std::pmr::vector<std::uint32_t> hidden;  ///< points of the input that belong to no cell
  Triangulation triangulation;
  RawVector<double> cell_values;  ///< indexed by cell of the triangulation
  /// For each cell, a bit for each vertex that is not in the lower end L of the cell's interval.
  RawVector<std::uint8_t> beyond;
  std::pmr::vector<CriticalFacet> facets;  ///< sorted by code
  // The next two members are empty unless the dimension is 3.
  NumberedEdges edges;
  RawVector<Edge> edge_states;  ///< indexed by edge
  // The next three members are empty unless the points have weights.
  RawVector<double> vertex_values;  ///< indexed by site; if empty, all are 0
  /// For each site, the edge with which the site is paired, or kCritical if the site is not paired.
  /// Below dimension 3, the other end of this edge is stored instead of the edge.
  RawVector<std::uint32_t> vertex_up;
  /// In dimension 3, for each site that is paired with an edge, a facet in the interval that
  /// contains the site and the edge. The entry is kNone if the interval has no other simplices.
  RawVector<std::uint32_t> vertex_facet;
};

/// Triangulates the points, and computes the values and the intervals of the simplices. Uses
/// threads.
/// @param period the length of the space along each axis, or empty if no axis is periodic. A length
/// of 0 means that the axis is not periodic.
/// @throws Error as sites_of and fold_points do; Error (resource, cancelled).
AlphaCells alpha_cells(PointsView points, std::span<const double> weights,
                       std::span<const double> period, const RunContext& context);

/// The value of a facet, given by either of its names. Takes O(log n) time for n critical facets.
double facet_value(const AlphaCells& cells, std::uint32_t code);
/// The value of a facet. Takes O(1) time. @param critical the entry of a critical facet; null for
/// any other facet.
double facet_value(const AlphaCells& cells, std::uint32_t code, const CriticalFacet* critical);
/// The entry of the facet with this name, or null if it is not critical.
const CriticalFacet* critical_facet(const AlphaCells& cells, std::uint32_t code);

class Frames;

/// Finds the values and the intervals of a triangulation of dimension 3, whose edges must already
/// be numbered. The second function does the same in dimensions 1 and 2.
void find_intervals_of_space(AlphaCells& cells, const Frames& frames, const RunContext& context);
void find_intervals_of_plane(AlphaCells& cells, const Frames& frames, const RunContext& context);

/// Because of rounding, the value of an interval may be smaller than the value of a face of its
/// simplices. Raises such an interval to the value of the face, and repeats this until no such
/// interval is left.
void make_monotone(AlphaCells& cells, const Frames& frames, const RunContext& context);

/// Asserts the lemmas behind the pairing in builds with assertions. The function does nothing in
/// other builds. The lemmas are: exact signs put each simplex into exactly one interval, whose
/// value it has; no face has a larger value than a coface; the Euler characteristic is 1, both for
/// all simplices and for the critical simplices. Triangulations of more than 20 000 cells are not
/// checked, because a check takes ten times as long as everything else.
void check_lemmas(const AlphaCells& cells);

}  // namespace ph::alpha
