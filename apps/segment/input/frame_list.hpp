// SPDX-License-Identifier: MIT
#pragma once
#include <deque>
#include <optional>
#include <string>

#include "ph/run_context.hpp"

namespace ph::segment {

/// Reads the lines of a list of frames from a file or a pipe, and returns each line as soon as it
/// has arrived.
class FrameList {
 public:
  /// @param path a path, where "-" is standard input. @param context outlives the list.
  /// @throws Error (no_input) if it is missing, unreadable or a folder.
  FrameList(const std::string& path, const RunContext& context);
  ~FrameList();
  FrameList(const FrameList&) = delete;
  FrameList& operator=(const FrameList&) = delete;

  /// The names that are known without waiting. These are all names of a file, but none of a pipe,
  /// because a pipe may have no end. `next` also returns these names. @throws like `next`.
  const std::deque<std::string>& known();
  /// Waits for the next name. @return nothing after the last name.
  /// @throws Error (io) if reading fails midway; Error (bad_data) on a NUL and on a line longer
  /// than names can be; Error (cancelled).
  std::optional<std::string> next();

 private:
  std::optional<std::string> read_name();
  std::optional<std::string> read_line();

  const RunContext& context_;
  std::string name_;  // printable
  int file_ = -1;
  bool is_file_ = false;  // true for a file; the end of a pipe may never come
  std::string read_;      // the bytes after the last line
  std::deque<std::string> ahead_;
};

}  // namespace ph::segment
