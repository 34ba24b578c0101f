// SPDX-License-Identifier: MIT
#pragma once
#include <initializer_list>
#include <stop_token>
#include <string>
#include <string_view>

#include "common/arguments/command_line.hpp"
#include "common/run/memory_limit.hpp"
#include "common/run/progress.hpp"
#include "ph/detail/io/output_file.hpp"
#include "ph/run_context.hpp"

namespace ph::app {

/// One run of a program: the context its computations run in and the way it talks to the user.
class Session {
 public:
  /// Sets up threads, memory limit, progress and stopping as the common options say.
  Session(std::string_view program, const CommonOptions& options, std::stop_token stop);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  const RunContext& context() const { return context_; }
  const CommonOptions& options() const { return options_; }

  /// The most memory that was resident so far, beyond what it was at the start; bytes.
  std::uint64_t memory_taken() const;

  /// One line on stderr in the words of the programs: `program: text`. Nothing with --quiet.
  void note(const Message& text);
  /// The same, only with --verbose.
  void explain(const Message& text);

  /// After a run that met the memory limit, see HeapBound::loosen.
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

/// As long as it lives no progress bar is drawn, and none after it before something is reported:
/// while results are written, which may go to the same terminal, while input is typed, and where
/// the next thing to come is not known.
class BarHold {
 public:
  explicit BarHold(Session& session);
  ~BarHold();
  BarHold(const BarHold&) = delete;
  BarHold& operator=(const BarHold&) = delete;

 private:
  ProgressReporter& progress_;
};

/// Whether one of the inputs is typed: standard input, "-", and that is a terminal.
bool is_typed(std::initializer_list<std::string_view> paths);

/// An output file whose temporary name is removed even if a signal ends the program at once. Open
/// outputs before long computations: what cannot be created is said first.
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
  int slot_ = -1;  // in the table of names to remove
};

/// Largest resident memory of the process so far, bytes.
std::uint64_t peak_memory();

}  // namespace ph::app
