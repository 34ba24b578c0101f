// SPDX-License-Identifier: MIT
#pragma once
#include <memory_resource>
#include <vector>

#include "ph/detail/diagram/ground_cost.hpp"
#include "ph/detail/diagram/point_tree.hpp"

namespace ph::diagram {

/// Points of a tree with changing weights: finds the point with the least cost minus weight. Each
/// node stores the largest weight of its points.
class WeightedTree {
 public:
  using Position = PointTree::Position;

  /// Weights are -infinity at first: such points do not exist. @param tree, cost must outlive this
  /// object.
  WeightedTree(const PointTree& tree, const GroundCost& cost, const RunContext& context);

  double weight(Position q) const { return weights_[q]; }
  void set(Position q, double weight);

  /// The two smallest values of cost minus weight; infinity if there is no such point.
  struct Best {
    double first, second;
    Position position = kNone;  // position of the first
  };
  /// @param near a position where to start: any will do, but one nearby is fast.
  Best best_two(const Point& p, Position near) const;

 private:
  using Node = PointTree::Node;

  double least(const Point& p, Node node) const {
    return cost_.pair_with_box(p, tree_.box(node)) - largest_[node];
  }
  void best_below(Node node, const Point& p, Best& best) const;

  const PointTree& tree_;
  const GroundCost& cost_;
  std::pmr::vector<double> weights_;  // by position
  std::pmr::vector<double> largest_;  // by node
};

}  // namespace ph::diagram
