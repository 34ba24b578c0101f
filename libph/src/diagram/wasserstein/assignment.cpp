// SPDX-License-Identifier: MIT
#include "libph/src/diagram/wasserstein/assignment.hpp"

#include <algorithm>
#include <cmath>

namespace ph::diagram {

Assignment::Side::Side(std::span<const Point> points, std::size_t others, const GroundCost& cost,
                       double most, const RunContext& context)
    : tree(points, context), prices(tree, cost, context), partner(points.size(), kNone) {
  for (Position q = 0; q < points.size(); ++q) {
    alone.push_back(std::min(cost.alone(tree.point(q)), most));
    // The first search begins at the same relative position of the other tree, because both trees
    // are divided along nearly the same axes.
    near.push_back(static_cast<Position>(std::uint64_t{q} * others / points.size()));
  }
}

WeightedTree::Best Assignment::best_two(std::size_t k, Position x) {
  Position& near = sides_[k].near[x];
  const WeightedTree::Best best = sides_[1 - k].prices.best_two(sides_[k].tree.point(x), near);
  if (best.position != kNone) near = best.position;
  return best;
}

void Assignment::raise_price(std::size_t k, Position x) {
  Side& mine = sides_[k];
  const double price = std::min(mine.alone[x], best_two(k, x).first);
  if (price != mine.prices.weight(x)) mine.prices.set(x, price);
}

Assignment::Costs Assignment::costs() const {
  long double cost = 0, lower = 0, sizes = 0;
  for (const std::size_t k : {0U, 1U}) {
    const Side& mine = sides_[k];
    for (Position x = 0; x < mine.tree.size(); ++x) {
      const double price = mine.prices.weight(x);
      lower += price;
      sizes += std::abs(price);
      if (mine.partner[x] == kNone)
        cost += mine.alone[x];
      else if (k == 0)
        cost += pair_cost(0, x, mine.partner[x]);
    }
  }
  // Each price is a rounded difference of two numbers. An allowance of twice the rounding unit is
  // enough.
  constexpr long double unit = 2.3e-16L;
  sizes += cost;
  return {static_cast<double>(cost),
          static_cast<double>(std::clamp(lower - 2 * unit * sizes, 0.0L, cost))};
}

std::vector<std::uint32_t> Assignment::partners() const {
  const Side &mine = sides_[0], &other = sides_[1];
  std::vector<std::uint32_t> partners(mine.tree.size(), kNone);
  for (Position x = 0; x < mine.tree.size(); ++x)
    if (mine.partner[x] != kNone)
      partners[mine.tree.places()[x]] = other.tree.places()[mine.partner[x]];
  return partners;
}

}  // namespace ph::diagram
