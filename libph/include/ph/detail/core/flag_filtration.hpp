// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <concepts>
#include <cstdint>
#include <span>

#include "ph/detail/core/raw_vector.hpp"
#include "ph/filtration.hpp"

namespace ph {

/// An edge of a flag complex with the value at which it enters; u > v.
struct FlagEdge {
  double value;
  std::uint32_t u, v;
};
using FlagEdges = RawVector<FlagEdge>;
/// The order of edges in a flag filtration: (value, u, v).
inline bool precedes(const FlagEdge& a, const FlagEdge& b) {
  if (a.value != b.value) return a.value < b.value;
  return a.u != b.u ? a.u < b.u : a.v < b.v;  // mutant: edge-order
}

class BinnedEdges;

// clang-format off

/// Capability: the clique complex of a graph. Its vertices 0 … vertex_count() - 1 have the order
/// (birth, number). A simplex enters with the last of its edges; the order is (position of that
/// edge, dimension, vertices read from the largest down).
template <class F>
concept FlagFiltration = Filtration<F> && requires(const F& f, std::uint32_t i) {
  { f.vertex_count() } -> std::convertible_to<std::size_t>;
  /// One birth per vertex; if empty, all vertices enter before all edges.
  { f.vertex_births() } -> std::convertible_to<std::span<const double>>;
  /// All edges in the order of the filtration, sorted on demand.
  { f.binned_edges() } -> std::same_as<const BinnedEdges&>;
  { f.vertex_cell(i) } -> std::same_as<typename F::Cell>;
  /// The edge at a position in the order.
  { f.edge_cell(i) } -> std::same_as<typename F::Cell>;
  /// The position, in the order, of the edge with these two vertices.
  { f.edge_position(i, i) } -> std::same_as<std::uint32_t>;
  /// The triangle spanned by the edge at a position and another vertex; that edge is the last of
  /// the triangle's three edges.
  { f.triangle_cell(i, i) } -> std::same_as<typename F::Cell>;
  /// The tetrahedron of the edge at a position and two other vertices; that edge is the last of its
  /// six edges.
  { f.tetrahedron_cell(i, i, i) } -> std::same_as<typename F::Cell>;
  /// The simplex of the edge at a position and three other vertices, descending; that edge is the
  /// last of its ten edges.
  { f.pentachoron_cell(i, std::array<std::uint32_t, 3>()) } -> std::same_as<typename F::Cell>;
  /// The triangle of three vertices, descending, that are joined by edges.
  { f.triangle_cell_of(i, i, i) } -> std::same_as<typename F::Cell>;
};

// clang-format on

}  // namespace ph
