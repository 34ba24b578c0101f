// SPDX-License-Identifier: MIT
#include <cassert>

#include "libph/src/alpha/intervals/frames.hpp"
#include "libph/src/alpha/intervals/marks.hpp"
#include "libph/src/alpha/intervals/spheres.hpp"

namespace ph::alpha {
namespace {

using std::uint32_t;

/// Finds the intervals of a triangulation of dimension 1 or 2. It finds each interval when it
/// visits the upper end of the interval.
class PlaneIntervals {
 public:
  PlaneIntervals(AlphaCells& cells, const Frames& frames, const RunContext& context)
      : cells_(cells),
        frames_(frames),
        context_(context),
        spheres_(frames.places()),
        vertices_(cells, context),
        critical_(cells.triangulation.size(), &context.memory) {}

  void run() {
    if (cells_.dim() == 1) {
      for (std::size_t t = 0; t < cells_.triangulation.size(); ++t) find_last_edge(t);
    } else {
      find_triangles();
    }
    vertices_.finish();
  }

 private:
  // Handles one edge of collinear sites, where edges are the cells.
  void find_last_edge(std::size_t t) {
    const auto& ends = cells_.triangulation.cells[t];
    const auto& at = frames_.of_cell(t);
    const Sphere sphere = spheres_.of_edge(at[0], at[1]);
    cells_.cell_values[t] = sphere.squared_radius;
    cells_.beyond[t] = sphere.beyond;
    if (sphere.beyond == 0) return;
    const unsigned vertex = sphere.beyond == 1 ? 1 : 0;
    vertices_.set_late(ends[vertex]);
    vertices_.pair(ends[vertex], ends[1 - vertex], sphere.squared_radius);
  }

  void find_triangles() {
    const std::size_t count = cells_.triangulation.size();
    for_each_piece("triangles", count, FacetPieces::kPiece, context_,
                   [&](std::size_t from, std::size_t to) {
                     for (std::size_t t = from; t < to; ++t) {
                       const auto& at = frames_.of_cell(t);
                       cells_.cell_values[t] = spheres_.triangle_radius(at[0], at[1], at[2]);
                       cells_.beyond[t] = spheres_.beyond_triangle(at[0], at[1], at[2]);
                     }
                   });
    for_each_piece("edges", count, FacetPieces::kPiece, context_,
                   [&](std::size_t from, std::size_t to) {
                     for (std::size_t t = from; t < to; ++t)
                       for (uint32_t k = 0; k < 3; ++k) {
                         const auto code = static_cast<uint32_t>(4 * t) + k;
                         const uint32_t other = cells_.triangulation.across[t][k];
                         if (other == kNone || other > code) find_edge(code, other);
                       }
                   });
    critical_.join(cells_.facets);
  }

  void find_edge(uint32_t code, uint32_t other) {
    const auto ends = cells_.facet_vertices(code);
    const bool is_in_first = cells_.belongs_to(code);
    const bool is_in_second = other != kNone && cells_.belongs_to(other);
    assert(!(is_in_first && is_in_second));  // at most one centre lies beyond the edge
    const bool is_empty = !is_in_first && !is_in_second;
    if (is_empty || cells_.sites.is_weighted()) {
      const auto at = frames_.of_facet(code);
      const Sphere sphere = spheres_.of_edge(at[0], at[1]);
      for (unsigned left = sphere.beyond; left != 0; left &= left - 1)
        vertices_.set_late(lowest(left) == 0 ? ends[1] : ends[0]);
      if (is_empty) {
        const unsigned late = sphere.beyond == 1 ? 1 : 0;
        if (sphere.beyond == 0)
          critical_[code >> 2].push_back({sphere.squared_radius, code});
        else
          vertices_.pair(ends[late], ends[1 - late], sphere.squared_radius);
        return;
      }
    }
    // The edge lies in the interval of a triangle, and is paired with the triangle or with a
    // vertex.
    const uint32_t name = is_in_first ? code : other;
    const std::size_t cell = name >> 2;
    const unsigned beyond = cells_.beyond[cell], first = lowest(beyond), k = name & 3;
    if (k == first) return;
    const auto& at = cells_.triangulation.cells[cell];
    // mutant: alpha-plane-vertex
    vertices_.pair(at[3 - first - k], at[first], cells_.cell_values[cell]);
  }

  AlphaCells& cells_;
  const Frames& frames_;
  const RunContext& context_;
  const Spheres spheres_;
  VertexIntervals vertices_;
  FacetPieces critical_;
};

}  // namespace

void find_intervals_of_plane(AlphaCells& cells, const Frames& frames, const RunContext& context) {
  PlaneIntervals(cells, frames, context).run();
}

}  // namespace ph::alpha
