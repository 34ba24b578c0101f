// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/metric/blocks/cell_boxes.hpp"
#include "libph/src/metric/blocks/sample_tree.hpp"

namespace ph {

/// For each node of the tree, a box around all points of the cloud that can be in the node, and the
/// largest possible distance from a point of that box to the sample. The box and the distance
/// follow from the splits of the tree and from a box around all points of the cloud.
class CellRegions {
 public:
  /// @param box the box around all points, as the smallest and the largest coordinate on each axis.
  CellRegions(const SampleTree& tree, std::span<const double> box, const RunContext& context);
  const CellBoxes& boxes() const { return boxes_; }  ///< one box per node

 private:
  void add(const SampleTree& tree, SampleTree::Node node, std::vector<double>& box);

  CellBoxes boxes_;
};

/// Finds the points of other blocks that may have an edge to a block in the minimum spanning tree
/// of the entire cloud. An edge (u, x) is not in that tree if shorter hops lead from u to x in
/// three stages. The first stage leads from u to a sample point in its own block. The second stage
/// leads through the sample to a sample point in the block of x. The third stage leads to x. A
/// point x is left out if there are such hops to x from every point u of the block (see
/// docs/explanation/engines/cloud-parts.md).
class NearPoints {
 public:
  using Node = SampleTree::Node;

  /// @param boxes two boxes per cell, around the points for which the sample point of the cell is
  /// the nearest. The first box is for points near the sample point (see
  /// Bottlenecks::square_around), and the second box is for all other points. The boxes must
  /// outlive this object.
  /// @param first_cell the position of the block's first cell in `boxes`.
  /// @param block must not be empty. @param limit the length up to which edges are needed.
  NearPoints(const SampleTree& tree, const Bottlenecks& bottlenecks, const CellRegions& regions,
             const CellBoxes& boxes, std::size_t first_cell, std::uint32_t block, double limit,
             const RunContext& context);

  enum class Place { elsewhere, near, inside };
  /// The place of a point of the cloud: inside the block, near it, or elsewhere.
  Place place(const double* x) const {
    Node node = SampleTree::kRoot;
    while (kinds_[node] == Kind::mixed) node = tree_.child(node, x);
    if (kinds_[node] == Kind::own) return Place::inside;
    if (kinds_[node] == Kind::hopeless) return Place::elsewhere;
    return is_near(x, node) ? Place::near : Place::elsewhere;
  }

  /// True if `block`, and not `other`, looks for edges between the two blocks. Each block looks for
  /// edges to about half of the other blocks.
  static bool looks_for(std::uint32_t block, std::uint32_t other, std::uint32_t blocks);

 private:
  enum class Kind : std::uint8_t { hopeless, mixed, cell, own };
  bool mark(Node node, const CellRegions& regions);
  bool may_be_near(Node node, const CellRegions& regions) const;
  bool is_near(const double* x, Node leaf) const;
  /// The square of an upper bound for the length of edges between a point of the block's node `own`
  /// and a point outside the block. @param square an upper bound for the squared distances from the
  /// two points to the sample.
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
  CellBoxes boxes_;  // one box per node below own_
  std::pmr::vector<Kind> kinds_;
};

}  // namespace ph
