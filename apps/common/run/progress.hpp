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

/// Shows progress on stderr: a bar on a terminal, one JSON object per line, or nothing. A bar
/// appears only after half a second, with the first report, and any message erases it. If a stage
/// has nothing to report for most of a second (a large array is moved, a file is read in one
/// piece), the last report is shown again, so that a computing program gives a sign of life every
/// second. Lines of JSON do this from the start, and are never held back.
class ProgressReporter {
 public:
  /// @param rank the rank of this process, if several compute together.
  ProgressReporter(ProgressMode mode, bool quiet, std::optional<int> rank = std::nullopt);
  ~ProgressReporter();

  bool active() const { return mode_ == ProgressMode::bar || mode_ == ProgressMode::json; }
  void report(const Progress& progress);
  /// Erases the bar and draws none until `release` was called equally often and another report
  /// comes: the terminal belongs to results, or to somebody who types.
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
  std::mutex mutex_;  // guards the members below
  Progress last_{"start", 0, 0};
  Clock::time_point last_shown_;
  bool has_report_ = false;  // since the start or the last hold
  int holds_ = 0;
  std::condition_variable_any never_;
  std::jthread repeater_;
};

}  // namespace ph::app
