// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <new>
#include <string>
#include <system_error>

#include "ph/io/barcode_io.hpp"

namespace ph::app {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(500);
constexpr auto kLongestSilence = std::chrono::milliseconds(800);

void write_text(std::string_view text) {
  static_cast<void>(!::write(STDERR_FILENO, text.data(), text.size()));
}

ProgressMode decided(ProgressMode mode, bool quiet) {
  if (mode != ProgressMode::automatic) return mode;
  return !quiet && isatty(STDERR_FILENO) ? ProgressMode::bar : ProgressMode::none;
}

}  // namespace

ProgressReporter::ProgressReporter(ProgressMode mode, bool quiet)
    : mode_(decided(mode, quiet)), start_(Clock::now()), last_shown_(start_) {
  if (!active()) return;
  try {
    repeater_ = std::jthread([this](const std::stop_token& stop) { repeat(stop); });
  } catch (const std::system_error&) {
    return;  // no room for a thread: only what is reported is shown
  }
}

ProgressReporter::~ProgressReporter() {
  repeater_ = {};
  clear();
}

void ProgressReporter::report(const Progress& progress) {
  const std::scoped_lock lock(mutex_);
  last_ = progress;
  show(progress);
}

void ProgressReporter::show(const Progress& progress) {
  last_shown_ = Clock::now();
  if (mode_ == ProgressMode::json) {
    const double seconds = std::chrono::duration<double>(last_shown_ - start_).count();
    write_text(fmt::format("{{\"stage\": {}, \"done\": {}, \"total\": {}, \"seconds\": {:.3f}}}\n",
                           json_string(progress.stage), progress.done,
                           progress.total == 0 ? "null" : std::to_string(progress.total), seconds));
  } else if (mode_ == ProgressMode::bar && last_shown_ - start_ >= kPatience) {
    draw_bar(progress);
  }
}

void ProgressReporter::repeat(const std::stop_token& stop) {
  try {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
      never_.wait_until(lock, stop, last_shown_ + kLongestSilence, [] { return false; });
      if (!stop.stop_requested() && Clock::now() >= last_shown_ + kLongestSilence) show(last_);
    }
  } catch (const std::bad_alloc&) {
    return;  // the computation will say so
  }
}

void ProgressReporter::draw_bar(const Progress& progress) {
  constexpr int kWidth = 30;
  std::string line = fmt::format("\r\x1b[K{} ", progress.stage);
  if (progress.total > 0) {
    const double part =
        std::min(1.0, static_cast<double>(progress.done) / static_cast<double>(progress.total));
    const int filled = static_cast<int>(part * kWidth);
    line += fmt::format("[{:#<{}}{:.<{}}] {:3.0f} %", "", filled, "", kWidth - filled, 100 * part);
  } else {
    line += fmt::format("{}", progress.done);
  }
  write_text(line);
  drawn_ = true;
}

void ProgressReporter::clear() {
  const std::scoped_lock lock(mutex_);
  if (drawn_) write_text("\r\x1b[K");
  drawn_ = false;
}

}  // namespace ph::app
