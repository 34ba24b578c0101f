// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/core/filtration.hpp"
#include "ph/core/run_context.hpp"
#include "ph/engine/elder_rule.hpp"
#include "ph/engine/merge_tree.hpp"
#include "ph/metric/metric.hpp"

namespace ph::segment {

/// The 1-skeleton of the Vietoris-Rips filtration of points in space: all that H0 needs (Section
/// V.A of the paper). The same filtration as ph::Rips over SparseDistances::within, built for one
/// use: voxels are few a cell, so a grid finds the pairs, and steps sort them.
///
/// A Filtration for libph's engines. A cell is a number: a vertex, or size() + the position of an
/// edge in the order (value, position of its vertices in the grid).
class Skeleton {
 public:
  using Cell = std::uint32_t;
  static constexpr bool first_equal_cofacet_is_oldest = false;  // it lists no cofacets

  /// @param points one point of R^3 a row, finite. @param distance longest edge, >= 0, inclusive.
  /// @param steps levels up to `distance` to which lengths are rounded up; 0: exact lengths.
  /// O(points log points + edges) for voxels not much smaller than `distance`.
  /// @throws Error (resource) beyond 2^32 - 2 cells or the memory limit.
  Skeleton(const Points& points, double distance, int steps,
           const RunContext& context = default_context());

  Index size() const { return static_cast<Index>(size_); }
  std::size_t edge_count() const { return edges_.size(); }
  std::span<const GraphEdge> edges() const { return edges_; }  ///< in the order of the filtration
  double edge_value(std::size_t edge) const { return values_[edge]; }

  // The contract of ph/core/filtration.hpp.
  int top_dim() const { return size_ == 0 ? -1 : edges_.empty() ? 0 : 1; }
  double value(Cell cell) const { return cell < size_ ? 0.0 : values_[cell - size_]; }
  bool precedes(Cell a, Cell b) const { return a < b; }
  template <class Visit>
  void for_each_cell(int dim, Visit&& visit) const {
    if (dim > 1) return;
    const auto first = dim == 0 ? 0U : size_;
    const auto last = static_cast<Cell>(dim == 0 ? size_ : slot_count());
    for (Cell c = first; c < last; ++c) visit(c);
  }
  template <class Visit>
  void for_each_facet(int dim, Cell cell, Visit&& visit) const {
    if (dim != 1) return;
    visit(edges_[cell - size_].u, 1);
    visit(edges_[cell - size_].v, -1);
  }
  CellKind cell_kind() const { return CellKind::vertices; }
  void append_input_cell(int dim, Cell cell, std::vector<Index>& numbers) const;
  std::size_t slot_count() const { return size_ + edges_.size(); }
  std::size_t slot(Cell cell) const { return cell; }

 private:
  std::uint32_t size_;
  std::pmr::vector<GraphEdge> edges_;  // u < v
  std::pmr::vector<double> values_;    // parallel to edges_, ascending
};

/// A value of the filtration: the smallest of the levels 0, distance/steps, 2*distance/steps, …,
/// distance that is not below `length`; `length` itself if `steps` is 0.
/// @param length from 0 to `distance`.
double filtration_value(double length, double distance, int steps);

/// H0 by union-find: which vertices join, at which value (Alg. 1 and 2 of the paper). Vertices are
/// born at 0; among equals the smaller one is the elder.
MergeTree merge_tree(const Skeleton& skeleton, const RunContext& context = default_context());

}  // namespace ph::segment
