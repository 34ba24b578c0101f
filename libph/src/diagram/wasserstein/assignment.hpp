// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "libph/src/diagram/wasserstein/weighted_tree.hpp"
#include "ph/detail/diagram/ground_cost.hpp"

namespace ph::diagram {

/// A matching between two sets of points, and prices that certify the quality of the matching. A
/// point may also stay alone. The cost is then the cost of moving the point to the diagonal.
///
/// The prices u of the first set and w of the second set are feasible: u_a + w_b <= cost(a, b) for
/// all pairs, u_a <= cost(a alone), and w_b <= cost(b alone). Every matching therefore costs at
/// least the sum of all prices. A matching costs exactly that sum under two conditions: u_a + w_b =
/// cost(a, b) for each of its pairs, and the price of each point without a partner is the cost of
/// that point alone.
class Assignment {
 public:
  using Position = PointTree::Position;

  /// The points of one diagram. Their prices and partners are listed by position in the tree.
  struct Side {
    PointTree tree;
    WeightedTree prices;
    std::vector<double> alone;      // the cost of each point without a partner
    std::vector<Position> partner;  // the position in the other tree, or kNone
    std::vector<Position> near;     // the position in the other tree where a search begins

    Side(std::span<const Point> points, std::size_t others, const GroundCost& cost, double most,
         const RunContext& context);
  };

  /// Starts without pairs, with prices of -infinity. Both sets must have points and outlive this
  /// object.
  /// @param most an upper bound for the cost of a point without a partner. It keeps the rounding
  /// errors of prices small. It does not change the optimal matching if some matching costs less
  /// than `most`.
  Assignment(std::span<const Point> a, std::span<const Point> b, const GroundCost& cost,
             const RunContext& context, double most = std::numeric_limits<double>::infinity())
      : cost_(cost),
        sides_{Side(a, b.size(), cost_, most, context), Side(b, a.size(), cost_, most, context)} {}
  Assignment(const Assignment&) = delete;
  Assignment& operator=(const Assignment&) = delete;

  Side& side(std::size_t k) { return sides_[k]; }
  const Side& side(std::size_t k) const { return sides_[k]; }
  const GroundCost& cost() const { return cost_; }

  double pair_cost(std::size_t k, Position x, Position y) const {
    return cost_.pair(sides_[k].tree.point(x), sides_[1 - k].tree.point(y));
  }
  /// The two best partners for point x of side k, at the prices of the other side.
  WeightedTree::Best best_two(std::size_t k, Position x);
  void pair(std::size_t k, Position x, Position y) {
    sides_[k].partner[x] = y;
    sides_[1 - k].partner[y] = x;
  }
  void part(std::size_t k, Position x) {
    Position& y = sides_[k].partner[x];
    if (y == kNone) return;
    sides_[1 - k].partner[y] = kNone;
    y = kNone;
  }
  /// Raises the price of point x of side k to the highest possible value. The prices remain
  /// feasible.
  void raise_price(std::size_t k, Position x);

  /// The matching costs `cost`, and no matching costs less than `lower`, with an allowance for
  /// rounding.
  struct Costs {
    double cost, lower;
  };
  Costs costs() const;
  /// For each point of the first set, in the order of the input, the place of its partner in the
  /// second set, or kNone.
  std::vector<std::uint32_t> partners() const;

 private:
  const GroundCost cost_;
  std::array<Side, 2> sides_;
};

/// Finds the best matching and its prices by shortest augmenting paths (Jonker, Volgenant 1987),
/// with one path for each point of the first set. It is slower than an auction, but has no
/// increments, so the number of its steps is bounded for any costs.
/// @param assignment may be in any state.
void assign_by_shortest_paths(Assignment& assignment, const RunContext& context);

}  // namespace ph::diagram
