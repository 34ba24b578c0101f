// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string_view>
#include <thread>

#include "command_line.hpp"
#include "ph/core/run_context.hpp"

namespace ph::app {

/// Shows progress on stderr: a bar on a terminal, a JSON object a line, or nothing. A bar appears
/// only after half a second, and is wiped away before anything else is written. Where a stage has
/// nothing to report for most of a second (a large array is moved, a file is read in one piece)
/// what was last reported is shown again, so that a program that lives is heard every second.
class ProgressReporter {
 public:
  explicit ProgressReporter(ProgressMode mode, bool quiet);
  ~ProgressReporter();

  bool active() const { return mode_ == ProgressMode::bar || mode_ == ProgressMode::json; }
  void report(const Progress& progress);
  /// Wipes the bar.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  void show(const Progress& progress);
  void draw_bar(const Progress& progress);
  void repeat(const std::stop_token& stop);

  ProgressMode mode_;
  Clock::time_point start_;
  std::mutex mutex_;  // of what follows and of standard error
  Progress last_{"start", 0, 0};
  Clock::time_point last_shown_;
  bool drawn_ = false;
  std::condition_variable_any never_;
  std::jthread repeater_;
};

}  // namespace ph::app
