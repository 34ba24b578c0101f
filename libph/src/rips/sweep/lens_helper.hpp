// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <cstddef>
#include <stop_token>
#include <system_error>
#include <thread>

#include "ph/run_context.hpp"
#include "rips/sweep/lens_scout.hpp"
#include "rips/sweep/star_writer.hpp"

namespace ph {

/// A thread that helps a sweep: it writes the stars that wait, and else looks at the lenses of
/// edges to come. What it finds saves the sweep time and changes nothing. If it fails, or there is
/// no thread to be had, the sweep does all by itself.
template <Field K>
class LensHelper {
 public:
  /// @param stars outlive this.
  LensHelper(StarWriter<K>& stars, std::size_t vertices, const BinnedEdges& edges,
             const RunContext& context)
      : scout_(vertices, edges, context) {
    stars.write_later();
    try {
      thread_ = std::jthread([this, &stars](const std::stop_token& stop) { run(stars, stop); });
    } catch (const std::system_error&) {
      return;  // the sweep writes them when it waits for them
    }
  }

  LensScout& scout() { return scout_; }

 private:
  void run(const StarWriter<K>& stars, const std::stop_token& stop) {
    bool can_scout = true;
    int idle = 0;  // turns
    while (!stop.stop_requested()) {
      bool has_worked = stars.write_next();
      try {
        if (!has_worked && can_scout) has_worked = scout_.step();
      } catch (...) {
        can_scout = false;  // what failed here will fail in the sweep, or does not matter
      }
      idle = has_worked ? 0 : idle + 1;
      rest(idle);
    }
  }
  // Who waits for a star writes it, so nobody waits for one who sleeps.
  static void rest(int idle) {
    constexpr int wakeful = 20;
    if (idle > wakeful)
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    else if (idle > 0)
      std::this_thread::yield();
  }

  LensScout scout_;
  std::jthread thread_;
};

}  // namespace ph
