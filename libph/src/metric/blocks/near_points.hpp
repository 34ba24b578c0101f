// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "metric/blocks/cell_boxes.hpp"
#include "metric/blocks/sample_tree.hpp"

namespace ph {

/// Where every point of a cloud may lie, cell by cell, as far as the splits and a box around all
/// say: nodes of the tree have a box and the farthest that a point of it may be from the sample.
class CellRegions {
 public:
  /// @param box around all points: least and largest coordinate, axis by axis.
  CellRegions(const SampleTree& tree, std::span<const double> box, const RunContext& context);
  const CellBoxes& boxes() const { return boxes_; }  ///< by node

 private:
  void add(const SampleTree& tree, SampleTree::Node node, std::vector<double>& box);

  CellBoxes boxes_;
};

/// Which points of other blocks may have an edge to a block in the minimum spanning tree of the
/// whole cloud. An edge (u, x) is none of it if hops that are all shorter lead from u to a point of
/// the sample in its block, on through the sample to one in the block of x, and to x. So x is left
/// out if that is so for all u; see docs/explanation/engines/cloud-parts.md.
class NearPoints {
 public:
  using Node = SampleTree::Node;

  /// @param boxes two by cell: of the points whose nearest one of the sample it has, first those
  /// nearby (Bottlenecks::square_around), then the others. They outlive this.
  /// @param first_cell of the block: its place in them.
  /// @param block one that is not empty. @param limit longer edges are not wanted.
  NearPoints(const SampleTree& tree, const Bottlenecks& bottlenecks, const CellRegions& regions,
             const CellBoxes& boxes, std::size_t first_cell, std::uint32_t block, double limit,
             const RunContext& context);

  enum class Place { elsewhere, near, inside };
  /// Of any point of the cloud.
  Place place(const double* x) const {
    Node node = SampleTree::kRoot;
    while (kinds_[node] == Kind::mixed) node = tree_.child(node, x);
    if (kinds_[node] == Kind::own) return Place::inside;
    if (kinds_[node] == Kind::hopeless) return Place::elsewhere;
    return is_near(x, node) ? Place::near : Place::elsewhere;
  }

  /// Whether `block` is the one that looks for edges between the two: each has half of the others.
  static bool looks_for(std::uint32_t block, std::uint32_t other, std::uint32_t blocks);

 private:
  enum class Kind : std::uint8_t { hopeless, mixed, cell, own };
  bool mark(Node node, const CellRegions& regions);
  bool may_be_near(Node node, const CellRegions& regions) const;
  bool is_near(const double* x, Node leaf) const;
  /// The square of the longest edge that points of a node of the block may have to another node, or
  /// a point. @param square of the distances of all of them to the sample, at most.
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
