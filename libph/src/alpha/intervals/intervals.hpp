// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "alpha/intervals/edges.hpp"
#include "alpha/intervals/places.hpp"
#include "alpha/triangulation/triangulation.hpp"

namespace ph::alpha {

/// What an edge of a triangulation of dimension 3 is paired with, in place of the name of a facet.
inline constexpr std::uint32_t kCritical = kNone;     ///< nothing inside its interval
inline constexpr std::uint32_t kJoins = kNone - 1;    ///< with a vertex: it joins components
inline constexpr std::uint32_t kUnknown = kNone - 2;  ///< while intervals are being made

struct Edge {
  double value;
  std::uint32_t up;  ///< the facet with which it is paired, or one of the above
};

/// A facet that is paired with nothing inside its interval.
struct CriticalFacet {
  double value = 0;
  std::uint32_t code = 0;  ///< its usual name
};

/// The vertices of a facet of a cell, ascending; as many as the dimension says.
inline std::array<std::uint32_t, 3> facet_of(const std::array<std::uint32_t, 4>& cell,
                                             std::uint32_t facet, int dim) {
  const auto& places = kFacetPlaces[facet];
  return {cell[places[0]], cell[places[1]], dim == 3 ? cell[places[2]] : kNone};
}

/// The alpha filtration of a triangulation, with the pairs of its intervals.
///
/// The simplices of one alpha value that belong together form an interval [L, U]: U has an empty
/// smallest sphere, and L are its vertices whose facets see the centre on their own side (Bauer &
/// Edelsbrunner, The Morse theory of Čech and Delaunay complexes, 2017). With a the first vertex of
/// U outside L, each simplex without a is paired with the one that has a in addition. What is left
/// is critical: those intervals that are one simplex.
///
/// Values are squared radii, in the units of the sites. They are the same for all of an interval,
/// and no face has a larger one than a coface.
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
  /// Whether a facet is paired with the cell of that name.
  bool is_facet_paired_up(std::uint32_t code) const {
    const unsigned places = beyond[code >> 2];
    return places != 0 && lowest(places) == (code & 3);
  }
  /// The same of either name.
  bool belongs_to(std::uint32_t code) const { return (beyond[code >> 2] >> (code & 3) & 1) != 0; }
  std::uint32_t across(std::uint32_t code) const {
    return triangulation.across[code >> 2][code & 3];
  }
  /// Of dimension 3: the edge between two places of a cell.
  std::uint32_t edge_between(std::size_t cell, unsigned i, unsigned k) const {
    return edges.between(triangulation, cell, i, k);
  }
  /// Of dimension 3: the edges of a facet, each opposite the vertex at its place.
  std::array<std::uint32_t, 3> facet_edges(std::uint32_t code) const {
    return edges.of_facet(triangulation, code);
  }
  /// The vertices of a facet, ascending; as many as the dimension says.
  std::array<std::uint32_t, 3> facet_vertices(std::uint32_t code) const {
    return facet_of(triangulation.cells[code >> 2], code & 3, dim());
  }

  Sites sites;
  bool is_periodic = false;                ///< the triangulation is a Delta-complex
  std::pmr::vector<std::uint32_t> hidden;  ///< points of the input that belong to no cell
  Triangulation triangulation;
  RawVector<double> cell_values;           ///< by cell of the triangulation
  RawVector<std::uint8_t> beyond;          ///< by cell: the vertices outside L
  std::pmr::vector<CriticalFacet> facets;  ///< by code
  // Of dimension 3:
  NumberedEdges edges;
  RawVector<Edge> edge_states;  ///< by edge
  // Of weights:
  RawVector<double> vertex_values;  ///< by site, or empty: all are 0
  /// By site: the edge with which it is paired, or the other end of it where dim is below 3, or
  /// kCritical.
  RawVector<std::uint32_t> vertex_up;
  /// By late site, of dimension 3: a facet of its interval; kNone if that is the site and an edge.
  RawVector<std::uint32_t> vertex_facet;
};

/// The triangulation of the points with values and intervals, on threads.
/// @param period one an axis, or none; 0: the axis does not close up.
/// @throws Error as sites_of and fold_points; (resource, cancelled).
AlphaCells alpha_cells(PointsView points, std::span<const double> weights,
                       std::span<const double> period, const RunContext& context);

/// The value of a facet, by either of its names. O(log of critical facets).
double facet_value(const AlphaCells& cells, std::uint32_t code);
/// The same. @param critical the facet if it is among the critical ones, else null. O(1).
double facet_value(const AlphaCells& cells, std::uint32_t code, const CriticalFacet* critical);
/// The critical facet of that name, or null.
const CriticalFacet* critical_facet(const AlphaCells& cells, std::uint32_t code);

class Frames;

/// Values and intervals: by dimension of the triangulation. Edges are numbered by then.
void find_intervals_of_space(AlphaCells& cells, const Frames& frames, const RunContext& context);
void find_intervals_of_plane(AlphaCells& cells, const Frames& frames, const RunContext& context);

/// Raises intervals that have a smaller value than a face of theirs, which rounding may do, to the
/// value of that face, until there are none.
void make_monotone(AlphaCells& cells, const Frames& frames, const RunContext& context);

/// Asserts what the pairing stands on, in builds with assertions; does nothing in others. Each
/// simplex lies in exactly one interval, by exact signs, and has its value. No face has a larger
/// value than a coface. The Euler characteristic is 1, of all simplices and of the critical ones.
/// Not of more than 20 000 cells, because it takes ten times as long as all else.
void check_lemmas(const AlphaCells& cells);

}  // namespace ph::alpha
