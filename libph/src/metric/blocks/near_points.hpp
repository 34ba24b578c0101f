// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/metric/blocks/cell_boxes.hpp"
#include "libph/src/metric/blocks/sample_tree.hpp"

namespace ph {

/// The regions of all points of a cloud, cell by cell, as far as the splits and a box around all
/// points determine them: each node of the tree has a box, and the largest distance from a point in
/// it to the sample.
class CellRegions {
 public:
  /// @param box around all points: smallest and largest coordinate, axis by axis.
  CellRegions(const SampleTree& tree, std::span<const double> box, const RunContext& context);
  const CellBoxes& boxes() const { return boxes_; }  ///< by node

 private:
  void add(const SampleTree& tree, SampleTree::Node node, std::vector<double>& box);

  CellBoxes boxes_;
};

/// Finds the points of other blocks that may have an edge to a block in the minimum spanning tree
/// of the entire cloud. An edge (u, x) is not in that tree if shorter hops lead from u to a point
/// of the sample in its block, on through the sample to a point in the block of x, and to x. A
/// point x is left out if this holds for all u; see docs/explanation/engines/cloud-parts.md.
class NearPoints {
 public:
  using Node = SampleTree::Node;

  /// @param boxes two per cell, for the points whose nearest point of the sample is the cell's:
  /// first for the points nearby (Bottlenecks::square_around), then for the others. They must
  /// outlive this object.
  /// @param first_cell the position of the block's first cell in them.
  /// @param block a block that is not empty. @param limit longer edges are not wanted.
  NearPoints(const SampleTree& tree, const Bottlenecks& bottlenecks, const CellRegions& regions,
             const CellBoxes& boxes, std::size_t first_cell, std::uint32_t block, double limit,
             const RunContext& context);

  enum class Place { elsewhere, near, inside };
  /// The place of any point of the cloud.
  Place place(const double* x) const {
    Node node = SampleTree::kRoot;
    while (kinds_[node] == Kind::mixed) node = tree_.child(node, x);
    if (kinds_[node] == Kind::own) return Place::inside;
    if (kinds_[node] == Kind::hopeless) return Place::elsewhere;
    return is_near(x, node) ? Place::near : Place::elsewhere;
  }

  /// True if `block` is the one that looks for edges between the two blocks: each block takes half
  /// of the others.
  static bool looks_for(std::uint32_t block, std::uint32_t other, std::uint32_t blocks);

 private:
  enum class Kind : std::uint8_t { hopeless, mixed, cell, own };
  bool mark(Node node, const CellRegions& regions);
  bool may_be_near(Node node, const CellRegions& regions) const;
  bool is_near(const double* x, Node leaf) const;
  /// The square of the longest edge that points of a node of the block may have to another node, or
  /// to a point. @param square an upper bound for their squared distances to the sample.
  double reach(Node own, double square, double within, SampleTree::Cell cell, double gap) const;
  std::size_t box_of(Node own_leaf) const {
    return 2 * (first_cell_ + (tree_.cells(own_leaf).begin - tree_.cells(own_).begin));
  }

  const SampleTree& tree_;
  const Bottlenecks& bottlenecks_;
  const std::uint32_t block_;
  const Node own_;
  const double limit_, longest_;
  const CellBoxes& cell_boxes_;
  const std::size_t first_cell_;
  CellBoxes boxes_;  // by node below own_
  std::pmr::vector<Kind> kinds_;
};

}  // namespace ph
