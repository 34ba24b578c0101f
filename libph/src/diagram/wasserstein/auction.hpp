// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <functional>

#include "libph/src/diagram/wasserstein/assignment.hpp"

namespace ph::diagram {

/// Finds a matching and prices by auction (Bertsekas 1988; forward and reverse: Bertsekas, Castañon
/// 1992), in rounds with decreasing increments.
class Auction {
 public:
  /// @param assignment without pairs; it must outlive this object.
  Auction(Assignment& assignment, const RunContext& context);

  /// Runs rounds until the costs are close enough, or until prices cannot be told apart any more.
  /// @param is_enough asked after each round.
  /// @param most_bids limit for the bids of a round; the auction is abandoned beyond it.
  /// @return false if it was abandoned: the assignment is meaningless then.
  bool run(const std::function<bool(const Assignment::Costs&)>& is_enough, std::uint64_t most_bids);

 private:
  using Position = PointTree::Position;

  /// Settles all points at increment_, which may rise to most_increment_. @return as settle.
  bool round(std::uint64_t most_bids);
  /// x bids for its best partner, and so does every point that is outbid.
  /// @return false if there are too many bids.
  bool settle(std::size_t k, Position x);

  Assignment& assignment_;
  Ticker ticker_;
  double increment_ = 0, most_increment_ = 0;
  std::uint64_t bids_ = 0, most_bids_ = 0, next_step_ = 0;  // bids in this round
};

}  // namespace ph::diagram
