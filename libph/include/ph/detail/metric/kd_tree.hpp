// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// A balanced k-d tree (Bentley 1975): each node is halved at the median of the axis along which
/// its points spread most. The tree is complete and needs no links: node 1 is the root, 2i and 2i +
/// 1 are the children of i, and the points of a node are consecutive in the order of the tree.
class KdTree {
 public:
  using Node = std::uint32_t;
  using Position = std::uint32_t;              ///< position of a point in the order of the tree
  static constexpr std::size_t kLeafSize = 8;  ///< largest number of points in a leaf

  /// O(n log n). @param points one per row, finite, with at least one column.
  /// @param rows the rows to take: at least one, fewer than 2^32 - 1.
  KdTree(PointsView points, std::span<const std::uint32_t> rows, const RunContext& context);

  std::size_t size() const { return rows_.size(); }
  /// The points in the order of the tree.
  PointsView points() const { return points_; }
  /// The row of each point, by position.
  std::span<const std::uint32_t> rows() const { return rows_; }

  Node first_leaf() const { return Node{1} << levels_; }
  Node node_count() const { return 2 * first_leaf(); }  ///< nodes are 1 … node_count() - 1
  bool is_leaf(Node node) const { return node >= first_leaf(); }
  Position begin(Node node) const { return bound(node, 0); }
  Position end(Node node) const { return bound(node, 1); }
  /// The leaf of a position.
  Node leaf_of(Position p) const {
    auto leaf = static_cast<Node>(first_leaf() + std::uint64_t{p} * first_leaf() / size());
    while (end(leaf) <= p) ++leaf;
    return leaf;
  }
  /// The smallest box around the points of a node: smallest and largest coordinate, axis by axis.
  const double* box(Node node) const { return boxes_.data() + node * box_size(); }

 private:
  struct Item {
    double key;
    std::uint32_t row;
  };
  Position bound(Node node, unsigned side) const {
    const int level = std::bit_width(node) - 1;
    const std::uint64_t place = node - (std::uint64_t{1} << level) + side;
    return static_cast<Position>(place * rows_.size() >> level);
  }
  std::size_t box_size() const { return 2 * static_cast<std::size_t>(points_.cols()); }
  /// Finds the box of a node and halves its items.
  void split(Node node, PointsView points, std::span<Item> items);
  void split_below(Node node, PointsView points, std::span<Item> items);

  int levels_ = 0;
  MemoryClaim claim_;  // counts the memory of points_
  Points points_;
  std::pmr::vector<std::uint32_t> rows_;
  std::pmr::vector<double> boxes_;
};

}  // namespace ph
