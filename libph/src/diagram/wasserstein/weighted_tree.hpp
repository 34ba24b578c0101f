// SPDX-License-Identifier: MIT
#pragma once
#include <memory_resource>
#include <vector>

#include "ph/detail/diagram/ground_cost.hpp"
#include "ph/detail/diagram/point_tree.hpp"

namespace ph::diagram {

/// The points of a tree with weights that may change. The class finds the points with the least
/// value of cost minus weight. Each node stores the largest weight of its points.
class WeightedTree {
 public:
  using Position = PointTree::Position;

  /// At first, all weights are -infinity. The search ignores points with this weight. @param tree,
  /// cost must outlive this object.
  WeightedTree(const PointTree& tree, const GroundCost& cost, const RunContext& context);

  double weight(Position q) const { return weights_[q]; }
  void set(Position q, double weight);

  /// The two smallest values of cost minus weight. A value is infinite if there is no point for it.
  struct Best {
    double first, second;
    Position position = kNone;  // the position of the point with the smallest value
  };
  /// @param near the position where the search starts. Any position is valid, but a position near p
  /// is faster.
  Best best_two(const Point& p, Position near) const;

 private:
  using Node = PointTree::Node;

  double least(const Point& p, Node node) const {
    return cost_.pair_with_box(p, tree_.box(node)) - largest_[node];
  }
  void best_below(Node node, const Point& p, Best& best) const;

  const PointTree& tree_;
  const GroundCost& cost_;
  std::pmr::vector<double> weights_;  // the weight of each position
  std::pmr::vector<double> largest_;  // the largest weight in each node
};

}  // namespace ph::diagram
