// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <functional>

#include "diagram/wasserstein/assignment.hpp"

namespace ph::diagram {

/// Finds a matching and prices by auction (Bertsekas 1988; forward and reverse: Bertsekas, Castañon
/// 1992), in rounds with ever smaller increments.
class Auction {
 public:
  /// @param assignment nobody paired; outlives this.
  Auction(Assignment& assignment, const RunContext& context);

  /// Rounds until the costs are near enough, or until prices cannot be told apart any more.
  /// @param is_enough asked after each round.
  /// @param most_bids of a round; beyond that the auction is given up.
  /// @return false if it was given up: then the assignment means nothing.
  bool run(const std::function<bool(const Assignment::Costs&)>& is_enough, std::uint64_t most_bids);

 private:
  using Position = PointTree::Position;

  /// Settles everybody at increment_, which may rise to most_increment_. @return as settle.
  bool round(std::uint64_t most_bids);
  /// x bids for who is best for it, and so does everybody who is outbid.
  /// @return false if there are too many bids.
  bool settle(std::size_t k, Position x);

  Assignment& assignment_;
  Ticker ticker_;
  double increment_ = 0, most_increment_ = 0;
  std::uint64_t bids_ = 0, most_bids_ = 0, next_step_ = 0;  // of this round
};

}  // namespace ph::diagram
