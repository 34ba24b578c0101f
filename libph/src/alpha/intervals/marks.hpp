// SPDX-License-Identifier: MIT
#pragma once
#include <atomic>
#include <cassert>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/alpha/intervals/intervals.hpp"
#include "ph/detail/core/parallel.hpp"

namespace ph::alpha {

/// Marks that several threads may set.
class Marks {
 public:
  Marks(std::size_t size, std::pmr::memory_resource* memory) : marks_(size, 0, memory) {}
  void set(std::size_t i) { std::atomic_ref(marks_[i]).store(1, std::memory_order_relaxed); }
  /// Precondition: no thread is setting marks.
  bool operator[](std::size_t i) const { return marks_[i] != 0; }

 private:
  std::pmr::vector<std::uint8_t> marks_;
};

/// Collects the critical facets that threads find piece by piece, and joins them in the order of
/// their names.
class FacetPieces {
 public:
  static constexpr std::size_t kPiece = 1 << 13;  // cells per piece

  FacetPieces(std::size_t cells, std::pmr::memory_resource* memory)
      : pieces_((cells + kPiece - 1) / kPiece, memory) {}
  std::pmr::vector<CriticalFacet>& operator[](std::size_t cell) { return pieces_[cell / kPiece]; }
  void join(std::pmr::vector<CriticalFacet>& all) {
    std::size_t count = 0;
    for (const auto& piece : pieces_) count += piece.size();
    all.reserve(count);
    for (auto& piece : pieces_) {
      all.insert(all.end(), piece.begin(), piece.end());
      piece = std::pmr::vector<CriticalFacet>(piece.get_allocator());
    }
  }

 private:
  std::pmr::vector<std::pmr::vector<CriticalFacet>> pieces_;
};

/// The values and the pairs of vertices. If the points have weights, some vertices are *late*: such
/// a vertex enters together with an edge.
class VertexIntervals {
 public:
  VertexIntervals(AlphaCells& cells, const RunContext& context)
      : cells_(cells),
        is_late_(cells.sites.is_weighted() ? cells.sites.size() : 0, &context.memory) {
    if (!cells.sites.is_weighted()) return;
    cells.vertex_values.resize(cells.sites.size());
    cells.vertex_up.assign(cells.sites.size(), kCritical);
    cells.vertex_facet.assign(cells.sites.size(), kNone);
  }
  /// Marks a vertex as late, because the other end of an edge lies inside its sphere.
  void set_late(std::uint32_t v) { is_late_.set(v); }
  /// Pairs a late vertex with an edge. @param up,facet the entries of the vertex in
  /// AlphaCells::vertex_up and AlphaCells::vertex_facet.
  void pair(std::uint32_t v, std::uint32_t up, double value, std::uint32_t facet = kNone) {
    assert(cells_.vertex_up[v] == kCritical);
    cells_.vertex_up[v] = up;
    cells_.vertex_values[v] = value;
    cells_.vertex_facet[v] = facet;
  }
  /// Sets the values of the vertices that are not late; these vertices enter alone.
  void finish() {
    for (std::size_t v = 0; v < cells_.vertex_values.size(); ++v) {
      assert(is_late_[v] == (cells_.vertex_up[v] != kCritical));
      if (cells_.vertex_up[v] == kCritical)  // mutant: alpha-late-vertex
        cells_.vertex_values[v] = -cells_.sites.weights[v] + 0.0;
    }
  }

 private:
  AlphaCells& cells_;
  Marks is_late_;
};

}  // namespace ph::alpha
