// SPDX-License-Identifier: MIT
#include "libph/src/diagram/wasserstein/assignment.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <vector>

namespace ph::diagram {
namespace {

constexpr double kGone = -std::numeric_limits<double>::infinity();

/// Grows trees of shortest paths (Dijkstra), one after another. The length of a step is its reduced
/// cost, which is the cost minus the prices.
class ShortestPaths {
 public:
  using Position = PointTree::Position;

  ShortestPaths(Assignment& assignment, const RunContext& context)
      : assignment_(assignment),
        mine_(assignment.side(0)),
        other_(assignment.side(1)),
        reached_from_(other_.tree.size()),
        ticker_(context, "Wasserstein distance, shortest paths") {
    for (Position x = 0; x < mine_.tree.size(); ++x) assignment.part(0, x);
    for (Position y = 0; y < other_.tree.size(); ++y) other_.prices.set(y, other_.alone[y]);
  }

  /// Extends the matching to x. Either x gets a partner, or x or another point of its set stays
  /// alone.
  void add(Position x) {
    assignment_.raise_price(0, x);
    nodes_.clear();
    steps_ = {};
    add_node(x, kNone, 0);
    Step step;
    for (;;) {
      step = steps_.top();
      steps_.pop();
      if (step.to == kNone) break;
      // Another path has already reached this point.
      if (other_.prices.weight(step.to) == kGone) {
        add_step(step.node);
        continue;
      }
      reached_from_[step.to] = step.node;
      if (other_.partner[step.to] == kNone) break;
      add_node(other_.partner[step.to], step.to, step.length);
      add_step(step.node);
    }
    for (const Node& node : nodes_) {
      const double rise = step.length - node.length;
      mine_.prices.set(node.x, mine_.prices.weight(node.x) + rise);
      if (node.y != kNone) other_.prices.set(node.y, node.price - rise);  // mutant: path-prices
    }
    change_pairs(step);
  }

 private:
  /// A point x of the tree, which was reached through its partner y. At the root of the tree, y is
  /// kNone.
  struct Node {
    Position x, y;
    double length;  // the length of the path from the root
    double price;   // the price of y before y was reached
  };
  /// A step from a node to the point `to` of the other set. If `to` is kNone, the step leaves the
  /// node's own point without a partner.
  struct Step {
    double length;
    std::size_t node;
    Position to;
    bool operator>(const Step& other) const {
      return std::tie(length, node, to) > std::tie(other.length, other.node, other.to);
    }
  };

  void add_node(Position x, Position y, double length) {
    double price = 0;
    if (y != kNone) {
      price = other_.prices.weight(y);
      other_.prices.set(y, kGone);
    }
    nodes_.push_back({x, y, length, price});
    steps_.push({length + (mine_.alone[x] - mine_.prices.weight(x)), nodes_.size() - 1, kNone});
    add_step(nodes_.size() - 1);
  }
  void add_step(std::size_t node) {
    ticker_.work();
    const Position x = nodes_[node].x;
    const WeightedTree::Best best = assignment_.best_two(0, x);
    if (best.position == kNone) return;
    // Rounding may make a cost negative.
    const double cost = std::max(0.0, best.first - mine_.prices.weight(x));
    steps_.push({nodes_[node].length + cost, node, best.position});
  }
  void change_pairs(const Step& last) {
    Position to = last.to;
    for (std::size_t node = last.node;;) {
      const auto [x, y, length, price] = nodes_[node];
      if (y != kNone) assignment_.part(0, x);
      if (to != kNone) assignment_.pair(0, x, to);
      if (y == kNone) return;
      to = y;
      node = reached_from_[y];
    }
  }

  Assignment& assignment_;
  Assignment::Side &mine_, &other_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> reached_from_;  // the node from which each position was reached
  std::priority_queue<Step, std::vector<Step>, std::greater<>> steps_;
  Ticker ticker_;
};

}  // namespace

void assign_by_shortest_paths(Assignment& assignment, const RunContext& context) {
  ShortestPaths paths(assignment, context);
  const std::size_t count = assignment.side(0).tree.size();
  for (PointTree::Position x = 0; x < count; ++x) paths.add(x);
  // Prices are computed again, which removes accumulated rounding errors.
  for (PointTree::Position x = 0; x < count; ++x) assignment.raise_price(0, x);
}

}  // namespace ph::diagram
