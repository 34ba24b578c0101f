// SPDX-License-Identifier: MIT
#include "libph/src/diagram/wasserstein/auction.hpp"

#include <algorithm>
#include <cmath>

namespace ph::diagram {
namespace {

/// The ratio of one increment to the next.
constexpr double kStep = 6;

/// In the first round, the increment is raised whenever this many bids per bar have been made.
constexpr std::uint64_t kBidsAStep = 3;

/// An upper bound for the rounding error of cost - price. If one bid is lower than another by more
/// than this bound, rounding is not the reason.
double rounding_of(double cost, double price) { return 1e-15 * (cost + std::abs(price)); }

}  // namespace

Auction::Auction(Assignment& assignment, const RunContext& context)
    : assignment_(assignment), ticker_(context, "Wasserstein distance") {
  // The first prices are feasible. They start at zero and are raised first on one side, then on the
  // other.
  Assignment::Side& mine = assignment_.side(0);
  for (Position x = 0; x < mine.tree.size(); ++x) mine.prices.set(x, 0);
  for (const std::size_t k : {1U, 0U})
    for (Position x = 0; x < assignment_.side(k).tree.size(); ++x) {
      ticker_.work();
      assignment_.raise_price(k, x);
    }
}

bool Auction::run(const std::function<bool(const Assignment::Costs&)>& is_enough,
                  std::uint64_t most_bids) {
  double alone = 0;
  std::size_t count = 0;
  for (const std::size_t k : {0U, 1U})
    for (const double cost : assignment_.side(k).alone) {
      alone += cost;
      ++count;
    }
  // The first increment is the mean of the first prices, because the cost of a pair is usually
  // about that large. For equal diagrams, these prices are zero. The increment is therefore at
  // least a thousandth of the mean cost of a point without a partner.
  increment_ = std::max(assignment_.costs().lower, 1e-3 * alone) / static_cast<double>(count);
  // If many points bid for few partners, prices must rise far. The first round may therefore raise
  // the increment up to this limit.
  most_increment_ = std::max(increment_, alone / static_cast<double>(count));
  for (;;) {
    if (!round(most_bids)) return false;
    const Assignment::Costs costs = assignment_.costs();
    // The cost of a pair exceeds the sum of its two prices by at most the increment. Once the
    // increments of all points together are this small, only rounding errors are left.
    if (is_enough(costs) || increment_ * static_cast<double>(count) <= 1e-14 * costs.cost)
      return true;
    increment_ /= kStep;
    most_increment_ = increment_;
  }
}

bool Auction::round(std::uint64_t most_bids) {
  Assignment::Side &mine = assignment_.side(0), &other = assignment_.side(1);
  bids_ = 0;
  most_bids_ = most_bids;
  next_step_ = kBidsAStep * (mine.tree.size() + other.tree.size());
  for (Position x = 0; x < mine.tree.size(); ++x) {
    ticker_.work();
    assignment_.raise_price(0, x);
    const Position y = mine.partner[x];
    if (y == kNone) continue;
    const double cost = assignment_.pair_cost(0, x, y);
    const double slack = cost - mine.prices.weight(x) - other.prices.weight(y);
    // mutant: auction-part
    if (slack > increment_ + rounding_of(cost, mine.prices.weight(x))) assignment_.part(0, x);
  }
  for (const std::size_t k : {0U, 1U}) {
    const Assignment::Side& side = assignment_.side(k);
    for (Position x = 0; x < side.tree.size(); ++x)
      if (side.partner[x] == kNone && side.prices.weight(x) < side.alone[x] && !settle(k, x))
        return false;
  }
  return true;
}

bool Auction::settle(std::size_t k, Position x) {
  Assignment::Side &mine = assignment_.side(k), &other = assignment_.side(1 - k);
  for (;;) {
    if (++bids_ > most_bids_) return false;
    if (bids_ == next_step_) {
      increment_ = std::min(increment_ * kStep, most_increment_);
      next_step_ += kBidsAStep * (mine.tree.size() + other.tree.size());
    }
    ticker_.work();
    const auto [first, second, y] = assignment_.best_two(k, x);
    const double alone = mine.alone[x];
    if (!(first < alone)) {
      mine.prices.set(x, alone);
      return true;
    }
    const double price = std::min(second, alone);  // mutant: auction-alone
    const Position outbid = other.partner[y];
    mine.prices.set(x, price);
    const double cost = assignment_.pair_cost(k, x, y);
    other.prices.set(y, cost - price - std::max(increment_, rounding_of(cost, price)));
    assignment_.pair(k, x, y);
    if (outbid == kNone) return true;
    mine.partner[outbid] = kNone;
    if (!(mine.prices.weight(outbid) < mine.alone[outbid])) return true;
    x = outbid;
  }
}

}  // namespace ph::diagram
