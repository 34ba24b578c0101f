// SPDX-License-Identifier: MIT
#include "apps/common/run/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <new>
#include <string>
#include <system_error>

#include "apps/common/terminal/messages.hpp"
#include "ph/detail/io/json_writer.hpp"

namespace ph::app {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(500);
constexpr auto kLongestSilence = std::chrono::milliseconds(800);

ProgressMode decided(ProgressMode mode, bool quiet) {
  if (mode != ProgressMode::automatic) return mode;
  return !quiet && isatty(STDERR_FILENO) ? ProgressMode::bar : ProgressMode::none;
}

}  // namespace

ProgressReporter::ProgressReporter(ProgressMode mode, bool quiet, std::optional<int> rank)
    : mode_(decided(mode, quiet)), rank_(rank), start_(Clock::now()), last_shown_(start_) {
  if (!active()) return;
  try {
    repeater_ = std::jthread([this](const std::stop_token& stop) { repeat(stop); });
  } catch (const std::system_error&) {
    // The system has no thread left, so only reports are shown.
    return;
  }
}

ProgressReporter::~ProgressReporter() {
  repeater_ = {};
  if (mode_ == ProgressMode::bar) wipe_status();
}

void ProgressReporter::report(const Progress& progress) {
  const std::scoped_lock lock(mutex_);
  last_ = progress;
  has_report_ = true;
  show();
}

void ProgressReporter::hold() {
  const std::scoped_lock lock(mutex_);
  ++holds_;
  has_report_ = false;
  if (mode_ == ProgressMode::bar) wipe_status();
}

void ProgressReporter::release() {
  const std::scoped_lock lock(mutex_);
  --holds_;
  has_report_ = false;
}

/// Must be called by a thread that has locked the mutex.
void ProgressReporter::show() {
  last_shown_ = Clock::now();
  if (mode_ == ProgressMode::json) {
    const double seconds = std::chrono::duration<double>(last_shown_ - start_).count();
    std::string members;
    json::add_members(members, {{"stage", json::string(last_.stage)},
                                {"done", json::integer(last_.done)},
                                {"total", last_.total == 0 ? "null" : json::integer(last_.total)},
                                {"seconds", fmt::format("{:.3f}", seconds)}});
    if (rank_)
      json::add_members(members, {{"rank", json::integer(static_cast<std::uint64_t>(*rank_))}});
    print_line("{" + members + "}");
  } else if (mode_ == ProgressMode::bar && has_report_ && holds_ == 0 &&
             last_shown_ - start_ >= kPatience) {
    draw_bar();
  }
}

void ProgressReporter::repeat(const std::stop_token& stop) {
  try {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
      never_.wait_until(lock, stop, last_shown_ + kLongestSilence, [] { return false; });
      if (!stop.stop_requested() && Clock::now() >= last_shown_ + kLongestSilence) show();
    }
  } catch (const std::bad_alloc&) {
    return;  // the computation will report the stop
  }
}

void ProgressReporter::draw_bar() {
  constexpr int width = 30;
  std::string line = fmt::format("{} ", last_.stage);
  if (last_.total > 0) {
    const double part =
        std::min(1.0, static_cast<double>(last_.done) / static_cast<double>(last_.total));
    const int filled = static_cast<int>(part * width);
    line += fmt::format("[{:#<{}}{:.<{}}] {:3.0f} %", "", filled, "", width - filled, 100 * part);
  } else {
    line += fmt::format("{}", last_.done);
  }
  show_status(line);
}

}  // namespace ph::app
