// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <string_view>

#include "command_line.hpp"
#include "ph/core/run_context.hpp"

namespace ph::app {

/// Shows progress on stderr: a bar on a terminal, a JSON object a line, or nothing. A bar appears
/// only after half a second, and is wiped away before anything else is written.
class ProgressReporter {
 public:
  explicit ProgressReporter(ProgressMode mode, bool quiet);
  ~ProgressReporter() { clear(); }

  bool active() const { return mode_ == ProgressMode::bar || mode_ == ProgressMode::json; }
  void report(const Progress& progress);
  /// Wipes the bar.
  void clear();

 private:
  void draw_bar(const Progress& progress);

  ProgressMode mode_;
  std::chrono::steady_clock::time_point start_;
  bool drawn_ = false;
};

}  // namespace ph::app
