// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <numeric>
#include <span>
#include <vector>

#include "ph/detail/core/flag_filtration.hpp"
#include "ph/detail/core/raw_vector.hpp"
#include "ph/detail/rips/binned_edges.hpp"

namespace ph {

/// For each vertex of a graph that grows edge by edge, the list of its neighbours, ascending. The
/// edges are known in advance, but their order is not. Each list therefore has exactly the room
/// that it will need.
/// @tparam Vertex an unsigned integer type that can number all vertices.
template <class Vertex>
class NeighbourLists {
 public:
  /// Makes lists of a graph without vertices.
  explicit NeighbourLists(std::pmr::memory_resource* memory)
      : begins_(memory), sizes_(memory), vertices_(memory) {}
  /// @param edges the edges that may be added later.
  NeighbourLists(std::size_t vertices, const BinnedEdges& edges, std::pmr::memory_resource* memory)
      : begins_(vertices, 0, memory), sizes_(vertices, 0, memory), vertices_(memory) {
    edges.with_bins(0, edges.bin_count(), [&](std::span<const FlagEdge> all) {
      for (const FlagEdge& e : all) {
        ++begins_[e.u];
        ++begins_[e.v];
      }
    });
    std::exclusive_scan(begins_.begin(), begins_.end(), begins_.begin(), std::size_t{0});
    vertices_.resize(2 * edges.size());
  }

  std::span<const Vertex> operator[](std::size_t v) const {
    return {vertices_.data() + begins_[v], sizes_[v]};
  }
  /// Adds one of the known edges, which must not be present yet.
  void add(const FlagEdge& e) {
    insert(e.u, static_cast<Vertex>(e.v));
    insert(e.v, static_cast<Vertex>(e.u));
  }

 private:
  void insert(std::size_t u, Vertex v) {
    Vertex* const begin = vertices_.data() + begins_[u];
    Vertex* const end = begin + sizes_[u]++;
    Vertex* const place = std::lower_bound(begin, end, v);  // mutant: neighbour-place
    std::copy_backward(place, end, end + 1);
    *place = v;
  }

  std::pmr::vector<std::size_t> begins_;  // start of each vertex's list in vertices_
  std::pmr::vector<std::uint32_t> sizes_;
  RawVector<Vertex> vertices_;
};

}  // namespace ph
