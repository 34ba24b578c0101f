// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/detail/core/flag_filtration.hpp"
#include "ph/filtration.hpp"

namespace ph {

/// The neighbours of each vertex in a graph with ranked edges, each with the edge that joins them.
/// An edge is known by its key: its position in the order, counted from 1. Key 0 belongs to the
/// vertices.
///
/// There are two layouts: a square matrix of keys if at least a quarter of the pairs are edges, and
/// sorted neighbour lists otherwise.
class RipsAdjacency {
 public:
  using Key = std::uint32_t;
  static constexpr Key kNever = UINT32_MAX;  ///< no edge

  struct Neighbour {
    std::uint32_t vertex;
    Key key;
  };

  RipsAdjacency(std::size_t vertices, std::span<const FlagEdge> edges,
                std::pmr::memory_resource* memory);

  /// True if a graph of this size gets the dense layout.
  static bool is_dense(std::size_t vertices, std::size_t edges);

  /// True if the layout is dense.
  bool has_matrix() const { return !matrix_.empty(); }
  /// Dense layout: the keys of all pairs with u; kNever at u itself.
  const Key* row(std::uint32_t u) const { return matrix_.data() + u * size_; }
  /// Sparse layout: the neighbours of u, ascending.
  std::span<const Neighbour> neighbours(std::uint32_t u) const {
    return std::span(neighbours_).subspan(offsets_[u], offsets_[u + 1] - offsets_[u]);
  }
  Key key_of(std::uint32_t u, std::uint32_t v) const {
    if (has_matrix()) return row(u)[v];
    const auto list = neighbours(u);
    const auto it = std::ranges::lower_bound(list, v, {}, &Neighbour::vertex);
    return it != list.end() && it->vertex == v ? it->key : kNever;
  }
  /// An upper bound for the number of vertices of a clique: the degeneracy of the graph plus one,
  /// or the number of vertices of the graph.
  Index clique_bound() const { return clique_bound_; }

 private:
  void lay_out_dense(std::span<const FlagEdge> edges);
  void lay_out_sparse(std::span<const FlagEdge> edges);
  Index degeneracy_bound(std::span<const FlagEdge> edges) const;

  std::size_t size_;
  Index clique_bound_ = 0;
  std::pmr::vector<Key> matrix_;  // dense layout
  std::pmr::vector<std::size_t> offsets_;
  std::pmr::vector<Neighbour> neighbours_;
};

}  // namespace ph
