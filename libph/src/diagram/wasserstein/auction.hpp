// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <functional>

#include "libph/src/diagram/wasserstein/assignment.hpp"

namespace ph::diagram {

/// Finds a matching and prices by auction (Bertsekas 1988), in rounds with decreasing increments.
/// The auction is both forward and reverse (Bertsekas, Castañon 1992).
class Auction {
 public:
  /// @param assignment must have no pairs, and must outlive this object.
  Auction(Assignment& assignment, const RunContext& context);

  /// Runs rounds until the costs are close enough, or until the increment is no larger than
  /// rounding errors.
  /// @param is_enough called after each round; true if the costs are close enough.
  /// @param most_bids the largest number of bids in a round, beyond which the auction is abandoned.
  /// @return false if the auction was abandoned. The assignment is then meaningless.
  bool run(const std::function<bool(const Assignment::Costs&)>& is_enough, std::uint64_t most_bids);

 private:
  using Position = PointTree::Position;

  /// Lets points bid until each of them has a partner or stays alone. The increment may rise from
  /// increment_ to most_increment_. @return false if there are too many bids.
  bool round(std::uint64_t most_bids);
  /// Point x bids for its best partner. Every point that is outbid then bids as well.
  /// @return false if there are too many bids.
  bool settle(std::size_t k, Position x);

  Assignment& assignment_;
  Ticker ticker_;
  double increment_ = 0, most_increment_ = 0;
  std::uint64_t bids_ = 0, most_bids_ = 0, next_step_ = 0;  // the numbers of bids in a round
};

}  // namespace ph::diagram
