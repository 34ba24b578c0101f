// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string_view>
#include <thread>

#include "apps/common/arguments/command_line.hpp"
#include "ph/run_context.hpp"

namespace ph::app {

/// Shows progress on stderr as a bar on a terminal or as one JSON object per line, or shows
/// nothing. A bar appears only after half a second, with the first report. Any message erases it. A
/// stage may have nothing to report for most of a second, for example while a large array is moved
/// or a file is read in one piece. In this case the last report is shown again, so that a computing
/// program shows every second that it is alive. Lines of JSON are repeated in the same way from the
/// start, and are never delayed.
class ProgressReporter {
 public:
  /// @param rank the rank of this process, if several processes compute together.
  ProgressReporter(ProgressMode mode, bool quiet, std::optional<int> rank = std::nullopt);
  ~ProgressReporter();

  bool active() const { return mode_ == ProgressMode::bar || mode_ == ProgressMode::json; }
  void report(const Progress& progress);
  /// Erases the bar. No bar is drawn until `release` has been called as often as `hold` and another
  /// report arrives. During this time, the terminal shows results, or somebody types in it.
  void hold();
  void release();

 private:
  using Clock = std::chrono::steady_clock;

  void show();
  void draw_bar();
  void repeat(const std::stop_token& stop);

  ProgressMode mode_;
  std::optional<int> rank_;
  Clock::time_point start_;
  std::mutex mutex_;  // protects the members below
  Progress last_{"start", 0, 0};
  Clock::time_point last_shown_;
  bool has_report_ = false;  // true if there was a report since the start or the last hold
  int holds_ = 0;
  std::condition_variable_any never_;
  std::jthread repeater_;
};

}  // namespace ph::app
