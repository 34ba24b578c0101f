// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "libph/src/cubical/graphs/top_graph.hpp"
#include "libph/src/cubical/graphs/voxel_graph.hpp"

namespace ph::cubical {

// These functions express the graph of H0 in terms of vertices and edges of the input. In the
// V-construction, these are voxels and the edges between voxels. In the T-construction, these are
// top cells and facets of the stars' grid (GridFrame), where all axes run backwards.

/// A step along an arrow.
struct ForestStep {
  StarCell edge;
  std::uint32_t to;
  bool from_upper;  ///< true if the step starts at the upper end of the edge
};

inline int axis_of(const Direction& d) { return d[0] != 0 ? 0 : d[1] != 0 ? 1 : 2; }

/// The voxel whose star contains a node.
inline std::uint32_t owner_of(const VoxelGraph&, std::uint32_t node) { return node; }
inline std::uint32_t owner_of(const TopGraph& graph, std::uint32_t node) {
  return graph.cell(node).voxel;
}

/// The step from a node, or nothing at a root.
inline std::optional<ForestStep> step_from(const StarGrid& grid, const VoxelGraph& graph,
                                           std::uint32_t node) {
  const std::uint32_t star = grid.star(node);
  if (StarTables::edges(star) == 0) return std::nullopt;
  const int number = grid.tables(node).arrow(star);
  const Direction& d = kEdges[number];
  return ForestStep{{node, d, 0},
                    graph.ends(node, static_cast<std::uint32_t>(number))[1],
                    d[axis_of_edge(number)] < 0};
}
inline std::optional<ForestStep> step_from(const StarGrid&, const TopGraph& graph,
                                           std::uint32_t node) {
  const StarCell top = graph.cell(node);
  const std::optional<int> axis = graph.exit_of(top);
  if (!axis) return std::nullopt;
  const int side = top.direction[*axis];
  return ForestStep{{top.voxel, turned(top.direction, *axis, 0), 0},
                    graph.node(top.voxel, turned(top.direction, *axis, -side)),
                    side < 0};
}

/// The start and the end of an edge. An edge points in the direction in which its axis runs in the
/// input.
inline std::array<std::uint32_t, 2> oriented_ends(const VoxelGraph& graph, const StarCell& edge) {
  const int number = number_of(edge.direction);
  const auto [near, far] = graph.ends(edge.voxel, static_cast<std::uint32_t>(number));
  if (edge.direction[axis_of_edge(number)] > 0) return {near, far};
  return {far, near};
}
inline std::array<std::uint32_t, 2> oriented_ends(const TopGraph& graph, const StarCell& facet) {
  const auto [low, high] =
      graph.ends(facet.voxel, static_cast<std::uint32_t>(number_of(facet.direction)));
  return {high, low};
}

}  // namespace ph::cubical
