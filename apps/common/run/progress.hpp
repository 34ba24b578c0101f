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
/// appears only after half a second, with the first report, and any message erases it. A stage may
/// have nothing to report for most of a second, for example while a large array is moved or a file
/// is read in one piece. In that case the last report is shown again, so that a computing program
/// gives a sign of life every second. Lines of JSON are repeated in this way from the start, and
/// are never held back.
class ProgressReporter {
 public:
  /// @param rank the rank of this process, if several compute together.
  ProgressReporter(ProgressMode mode, bool quiet, std::optional<int> rank = std::nullopt);
  ~ProgressReporter();

  bool active() const { return mode_ == ProgressMode::bar || mode_ == ProgressMode::json; }
  void report(const Progress& progress);
  /// Erases the bar. No bar is drawn until `release` has been called as often as `hold` and another
  /// report comes. Meanwhile the terminal shows results, or somebody types in it.
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
