// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/detail/core/bit_matrix.hpp"

namespace ph {

/// Some edges of a graph. Each edge is listed at both of its ends, in no particular order, with a
/// label at each end. The label contains the data of the edge as seen from this end. To find a
/// label, the list of a vertex is scanned, because a vertex has few of these edges.
class ActiveEdges {
 public:
  using Vertex = std::uint32_t;
  using Label = std::uint32_t;

  /// @param has_rows true if edges are also stored as rows of bits, with one bit for each pair of
  /// vertices.
  ActiveEdges(std::size_t vertices, bool has_rows, std::pmr::memory_resource* memory)
      : at_(memory),
        degrees_(vertices, 0, memory),
        rows_(has_rows ? vertices : 0, vertices, memory) {
    at_.resize(vertices);
  }

  std::size_t vertex_count() const { return at_.size(); }
  /// The other ends of the edges at a vertex. Precondition: !has_rows().
  std::span<const Vertex> neighbours(Vertex v) const { return at_[v].neighbours; }
  std::size_t degree(Vertex v) const { return degrees_[v]; }
  bool has_rows() const { return rows_.rows() != 0; }
  /// The other ends of the edges at a vertex, as bits. Precondition: has_rows().
  const bits::Word* row(Vertex v) const { return rows_.row(v); }
  std::size_t words() const { return rows_.words(); }  ///< words per row
  /// The label at u of the edge from u to v, or null if the edge is absent. The pointer is valid
  /// until the next change.
  Label* find(Vertex u, Vertex v);
  /// Adds an edge that was never present. @param at_u, at_v its labels at u and at v.
  void insert(Vertex u, Vertex v, Label at_u, Label at_v);
  /// Removes all edges.
  void clear();
  /// Removes an edge. Precondition: the edge is present.
  void erase(Vertex u, Vertex v);

 private:
  struct Ends {
    using allocator_type = std::pmr::polymorphic_allocator<>;
    explicit Ends(allocator_type allocator) : neighbours(allocator), labels(allocator) {}
    Ends(Ends&&) noexcept = default;
    Ends(Ends&& other, allocator_type allocator)
        : neighbours(std::move(other.neighbours), allocator),
          labels(std::move(other.labels), allocator) {}
    std::pmr::vector<Vertex> neighbours;
    std::pmr::vector<Label> labels;
  };
  void erase_at(Vertex u, Vertex v);

  // The list of each vertex. With rows, lists may still contain removed edges, because searching
  // for each removed edge would take longer than occasionally cleaning up a list.
  std::pmr::vector<Ends> at_;
  // The number of edges at each vertex. This is the most frequent query, and the answer is usually
  // 0.
  std::pmr::vector<std::uint32_t> degrees_;
  BitMatrix rows_;
};

}  // namespace ph
