// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "ph/io/barcode_io.hpp"

namespace ph::app {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kPatience = std::chrono::milliseconds(500);

void write_text(std::string_view text) {
  static_cast<void>(!::write(STDERR_FILENO, text.data(), text.size()));
}

ProgressMode decided(ProgressMode mode, bool quiet) {
  if (mode != ProgressMode::automatic) return mode;
  return !quiet && isatty(STDERR_FILENO) ? ProgressMode::bar : ProgressMode::none;
}

}  // namespace

ProgressReporter::ProgressReporter(ProgressMode mode, bool quiet)
    : mode_(decided(mode, quiet)), start_(Clock::now()) {}

void ProgressReporter::report(const Progress& progress) {
  if (mode_ == ProgressMode::json) {
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    write_text(fmt::format("{{\"stage\": {}, \"done\": {}, \"total\": {}, \"seconds\": {:.3f}}}\n",
                           json_string(progress.stage), progress.done,
                           progress.total == 0 ? "null" : std::to_string(progress.total), seconds));
  } else if (mode_ == ProgressMode::bar && Clock::now() - start_ >= kPatience) {
    draw_bar(progress);
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
  if (drawn_) write_text("\r\x1b[K");
  drawn_ = false;
}

}  // namespace ph::app
