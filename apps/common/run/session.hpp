// SPDX-License-Identifier: MIT
#pragma once
#include <initializer_list>
#include <stop_token>
#include <string>
#include <string_view>

#include "apps/common/arguments/command_line.hpp"
#include "apps/common/run/progress.hpp"
#include "apps/common/system/memory_limit.hpp"
#include "ph/detail/io/output_file.hpp"
#include "ph/run_context.hpp"

namespace ph::app {

/// One run of a program: the context of its computations and its communication with the user.
class Session {
 public:
  /// Sets up threads, memory limit, progress and stopping from the common options.
  Session(std::string_view program, const CommonOptions& options, std::stop_token stop);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  const RunContext& context() const { return context_; }
  const CommonOptions& options() const { return options_; }

  /// The largest increase of the resident memory since the start, in bytes.
  std::uint64_t memory_taken() const;

  /// Writes one line to stderr in the form `program: text`, which all programs use. With --quiet,
  /// writes nothing.
  void note(const Message& text);
  /// Writes a line in the same form, but only with --verbose.
  void explain(const Message& text);

  /// Must be called after a run that reached the memory limit (see HeapBound::loosen).
  void loosen_heap_bound() { heap_.loosen(); }

 private:
  friend class BarHold;

  std::string program_;
  CommonOptions options_;
  ProgressReporter progress_;
  RunContext context_;
  HeapBound heap_;
  std::uint64_t memory_at_start_;
};

/// While this object lives, and afterwards until the next report, no progress bar is drawn. The
/// object is used while results are written, because they may be written to the same terminal. It
/// is also used while input is typed, and while the next step is unknown.
class BarHold {
 public:
  explicit BarHold(Session& session);
  ~BarHold();
  BarHold(const BarHold&) = delete;
  BarHold& operator=(const BarHold&) = delete;

 private:
  ProgressReporter& progress_;
};

/// True if one of the paths is "-" and standard input is a terminal, so that somebody types the
/// input.
bool is_typed(std::initializer_list<std::string_view> paths);

/// An output file whose temporary name is removed even if a signal ends the program at once.
/// Outputs should be opened before long computations, so that failures to create them are reported
/// first.
class Output {
 public:
  explicit Output(const std::string& path);
  ~Output();
  Output(Output&&) noexcept;
  Output& operator=(Output&&) = delete;

  OutputFile& file() { return file_; }
  void write(std::string_view bytes) { file_.write(bytes); }
  void commit();

 private:
  OutputFile file_;
  int slot_ = -1;  // the index in the table of names to remove
};

}  // namespace ph::app
