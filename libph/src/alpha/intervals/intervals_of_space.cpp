// SPDX-License-Identifier: MIT
#include <cassert>

#include "libph/src/alpha/intervals/frames.hpp"
#include "libph/src/alpha/intervals/marks.hpp"
#include "libph/src/alpha/intervals/spheres.hpp"

namespace ph::alpha {
namespace {

using std::uint32_t;

/// Finds the intervals of a triangulation of dimension 3. It visits their upper ends, which are the
/// simplices with an empty smallest sphere: first tetrahedra, then triangles, then edges. The
/// smallest sphere of a facet is not empty if the centre of an adjacent tetrahedron lies beyond the
/// facet; the same holds for an edge and an adjacent triangle.
class SpaceIntervals {
 public:
  SpaceIntervals(AlphaCells& cells, const Frames& frames, const RunContext& context)
      : cells_(cells),
        frames_(frames),
        context_(context),
        spheres_(frames.places()),
        is_not_empty_(cells.edge_states.size(), &context.memory),
        vertices_(cells, context),
        critical_(cells.triangulation.size(), &context.memory) {}

  void run() {
    const std::size_t count = cells_.triangulation.size();
    for_each_piece("tetrahedra", count, FacetPieces::kPiece, context_,
                   [&](std::size_t from, std::size_t to) {
                     for (std::size_t t = from; t < to; ++t) {
                       const Sphere sphere = spheres_.of_tetrahedron(frames_.of_cell(t));
                       cells_.cell_values[t] = sphere.squared_radius;
                       cells_.beyond[t] = sphere.beyond;
                     }
                   });
    for_each_piece("triangles", count, FacetPieces::kPiece, context_,
                   [&](std::size_t from, std::size_t to) {
                     for (std::size_t t = from; t < to; ++t)
                       for (uint32_t k = 0; k < 4; ++k) {
                         const auto code = static_cast<uint32_t>(4 * t) + k;
                         const uint32_t other = cells_.triangulation.across[t][k];
                         if (other == kNone || other > code) find_facet(code, other);
                       }
                   });
    critical_.join(cells_.facets);
    constexpr std::size_t piece = 1 << 14;
    for_each_piece("edges", cells_.edge_states.size(), piece, context_,
                   [&](std::size_t from, std::size_t to) {
                     for (std::size_t e = from; e < to; ++e) find_edge(static_cast<uint32_t>(e));
                   });
    vertices_.finish();
  }

 private:
  void pair_edge(uint32_t edge, uint32_t facet, double value) {
    Edge& state = cells_.edge_states[edge];
    assert(state.up == kUnknown);  // a simplex lies in one interval
    state = {value, facet};
  }
  // Pairs an edge with the late vertex (see VertexIntervals) that enters with it.
  void pair_vertex(uint32_t vertex, uint32_t edge, double value, uint32_t facet = kNone) {
    pair_edge(edge, kJoins, value);
    vertices_.pair(vertex, edge, value, facet);
  }

  // Finds the interval of a facet. @param code the usual name of the facet. @param other the other
  // name of the facet, or kNone if it has only one.
  void find_facet(uint32_t code, uint32_t other) {
    const uint32_t cell = code >> 2;
    const auto& places = kFacetPlaces[code & 3];
    const auto [a, b, c] = frames_.of_facet(code);
    const unsigned beyond = spheres_.beyond_triangle(a, b, c);
    for (unsigned left = beyond; left != 0; left &= left - 1) {
      const unsigned i = lowest(left);
      is_not_empty_.set(cells_.edge_between(cell, places[(i + 1) % 3], places[(i + 2) % 3]));
    }
    const bool is_in_first = cells_.belongs_to(code);
    const bool is_in_second = other != kNone && cells_.belongs_to(other);
    assert(!(is_in_first && is_in_second));  // at most one centre lies beyond the facet
    if (is_in_first || is_in_second) return give_to_tetrahedron(is_in_first ? code : other);
    if (beyond == 0) {  // mutant: alpha-obtuse
      critical_[cell].push_back({spheres_.triangle_radius(a, b, c), code});
      return;
    }
    // This triangle is the upper end of its interval.
    const double value = spheres_.triangle_radius(a, b, c);
    const unsigned first = lowest(beyond);
    pair_edge(cells_.edge_between(cell, places[(first + 1) % 3], places[(first + 2) % 3]), code,
              value);
    if (const unsigned rest = beyond & (beyond - 1); rest != 0) {
      const unsigned vertex = 3 - first - lowest(rest);  // mutant: alpha-triangle-vertex
      pair_vertex(cells_.triangulation.cells[cell][places[vertex]],
                  cells_.edge_between(cell, places[vertex], places[first]), value, code);
    }
  }

  // Pairs a facet that lies in the interval of a tetrahedron. @param code the name of the facet in
  // that tetrahedron.
  void give_to_tetrahedron(uint32_t code) {
    const uint32_t cell = code >> 2;
    // mutant: alpha-facet-of-edge
    const unsigned beyond = cells_.beyond[cell], first = lowest(beyond), k = code & 3;
    const double value = cells_.cell_values[cell];
    // The facet is paired with the edge that contains neither vertex k nor vertex `first`.
    if (k != first) {
      const unsigned rest = 0b1111U & ~(1U << first) & ~(1U << k);
      pair_edge(cells_.edge_between(cell, lowest(rest), lowest(rest & (rest - 1))), code, value);
      return;
    }
    if (std::popcount(beyond) < 3) return;  // mutant: alpha-tetrahedron-vertex
    const unsigned vertex = lowest(0b1111U & ~beyond);
    pair_vertex(cells_.triangulation.cells[cell][vertex], cells_.edge_between(cell, vertex, first),
                value, code);
  }

  void find_edge(uint32_t e) {
    const auto [a, b] = cells_.edges.ends[e];
    Edge& state = cells_.edge_states[e];
    if (!cells_.sites.is_weighted() && is_not_empty_[e]) {
      assert(state.up != kUnknown);  // the edge is the lower end of exactly one interval
      return;
    }
    const auto& at = frames_.of_edge(e);
    const Sphere sphere = spheres_.of_edge(at[0], at[1]);
    for (unsigned left = sphere.beyond; left != 0; left &= left - 1)
      vertices_.set_late(lowest(left) == 0 ? b : a);
    if (is_not_empty_[e]) {
      assert(state.up != kUnknown);
      return;
    }
    assert(state.up == kUnknown);
    if (sphere.beyond == 0) {
      state = {sphere.squared_radius, kCritical};
      return;
    }
    pair_vertex(sphere.beyond == 1 ? b : a, e, sphere.squared_radius);  // mutant: alpha-edge-vertex
  }

  AlphaCells& cells_;
  const Frames& frames_;
  const RunContext& context_;
  const Spheres spheres_;
  Marks is_not_empty_;  // for each edge: true if the smallest sphere of the edge is not empty
  VertexIntervals vertices_;
  FacetPieces critical_;
};

}  // namespace

void find_intervals_of_space(AlphaCells& cells, const Frames& frames, const RunContext& context) {
  cells.edge_states.assign(cells.edges.ends.size(), Edge{0, kUnknown});
  SpaceIntervals(cells, frames, context).run();
}

}  // namespace ph::alpha
