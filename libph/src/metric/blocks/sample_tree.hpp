// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Divides space into blocks that contain about equally many points of a cloud, and each block into
/// cells. It is a k-d tree (Bentley 1975) over a sample of the cloud. Its leaves are the cells,
/// each of which contains one point of the sample. The division depends only on comparisons and is
/// therefore the same in every process that reads the cloud. Equal points are in the same cell, and
/// each point of the sample is in its own cell.
///
/// Cells are numbered from one side to the other. Blocks are numbered in the same way, and a block
/// consists of consecutive cells.
class SampleTree {
 public:
  using Node = std::uint32_t;
  using Cell = std::uint32_t;
  static constexpr Node kRoot = 0, kNone = UINT32_MAX;
  struct Range {
    std::uint32_t begin, end;
    std::uint32_t size() const { return end - begin; }
  };

  /// @param points one per row. @param sample the number of points to draw, which must be at most
  /// the number of all points and less than 2^31. @param blocks at least one; if there are more
  /// blocks than distinct points, some blocks are empty.
  /// @throws Error (bad_data) if it reads a coordinate that is not finite.
  SampleTree(PointsView points, std::size_t sample, std::uint32_t blocks,
             const RunContext& context);

  std::uint32_t cell_count() const { return static_cast<std::uint32_t>(numbers_.size()); }
  /// The sample point of each cell. These points are distinct.
  PointsView points() const { return points_; }
  /// The number of the cell's sample point in the cloud.
  Index number(Cell cell) const { return numbers_[cell]; }

  /// Children come after their parent, and the left child comes directly after it. All nodes below
  /// a node are consecutive.
  std::uint32_t node_count() const { return static_cast<std::uint32_t>(splits_.size()); }
  bool is_leaf(Node node) const { return splits_[node].right == 0; }
  Node left(Node node) const { return node + 1; }
  Node right(Node node) const { return splits_[node].right; }
  /// The first node after all nodes below `node`. Precondition: `node` has only one block.
  Node end_below(Node node) const {
    return cells(node).size() == 0 ? node + 1 : node + 2 * cells(node).size() - 1;
  }
  /// The cells of a node. A leaf has one cell, or no cell if it is empty.
  Range cells(Node node) const { return cells_[node]; }
  Range blocks(Node node) const { return blocks_[node]; }
  /// The node that consists of exactly this block.
  Node node_of_block(std::uint32_t block) const { return block_nodes_[block]; }
  /// The axis and the value of a node's split. On this axis, coordinates on the left are at most
  /// the value, and coordinates on the right are at least the value. If the value is -infinity, all
  /// points are on the right.
  std::uint32_t axis(Node node) const { return splits_[node].axis; }
  double value(Node node) const { return splits_[node].value; }

  /// The child of an inner node that contains the point x.
  Node child(Node node, const double* x) const {
    const Split& split = splits_[node];
    const double at = x[split.axis];
    // mutant: cloud-tie
    const bool is_left = at != split.value ? at < split.value : precedes(x, split);
    return is_left ? node + 1 : split.right;
  }

 private:
  struct Split {
    double value;
    Node right;  // 0 for a leaf
    std::uint32_t axis;
    // The first point on the right. During construction this is a row of drawn_, and afterwards a
    // cell.
    std::uint32_t point;
  };
  /// True if x comes before the first point on the right. Coordinates are compared one after
  /// another, beginning at the axis of the split. After the last axis, the comparison continues
  /// with the first axis.
  bool precedes(const double* x, const Split& split) const;
  void draw(PointsView points, std::size_t sample, const RunContext& context);
  void split(Range cells, Range blocks, std::span<std::uint32_t> order);

  Points points_;
  std::vector<Index> numbers_;
  std::pmr::vector<Split> splits_;
  std::pmr::vector<Range> cells_, blocks_;
  std::vector<Node> block_nodes_;
};

/// A point of the sample, given by its cell, and its squared distance from another point.
struct NearSample {
  SampleTree::Cell cell;
  double square;
};
/// The sample point in a block that is nearest to x. @param known any sample point of the block,
/// from which the search starts.
NearSample nearest_sample(const SampleTree& tree, std::uint32_t block, const double* x,
                          NearSample known);

/// The bottleneck distances between points of a sample. The bottleneck of two points is the least
/// number r such that hops of length at most r within the sample lead from one point to the other.
/// It is the length of the longest edge on the path between the two points in a minimum spanning
/// tree.
class Bottlenecks {
 public:
  /// @param largest the largest coordinate of the cloud, as for PointMetric.
  Bottlenecks(const SampleTree& tree, double largest, const RunContext& context);

  /// The bottleneck of two cells, in O(log cells).
  double between(SampleTree::Cell a, SampleTree::Cell b) const {
    double longest = 0;
    while (a != b) {
      std::uint32_t& from = length_[a] <= length_[b] ? a : b;
      longest = length_[from];
      from = parent_[from];
    }
    return longest;
  }
  /// The square of twice the least bottleneck between this cell and another cell. A point counts as
  /// near the sample point of this cell if its squared distance is at most this square. Such a
  /// distance at most doubles the bound for the length of an edge.
  double square_around(SampleTree::Cell cell) const {
    const double twice = 2 * first_[cell];
    return twice * twice;
  }
  /// The largest bottleneck between two cells of a node.
  double within(SampleTree::Node node) const { return within_[node]; }

  struct Edge {
    double length;
    SampleTree::Cell a, b;
  };
  /// The edges of the minimum spanning tree, shortest first.
  std::span<const Edge> edges() const { return edges_; }

 private:
  std::pmr::vector<std::uint32_t> parent_;
  std::pmr::vector<double> length_;  // length of the edge by which a set joined its parent's set
  std::pmr::vector<double> first_;   // length of the shortest edge of each cell
  std::pmr::vector<double> within_;
  std::pmr::vector<Edge> edges_;
};

}  // namespace ph
