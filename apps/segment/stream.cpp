// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <string_view>

#include "apps/common/run/program.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/segment/input/frames.hpp"
#include "apps/segment/run.hpp"
#include "ph/detail/io/json_writer.hpp"
#include "ph/error.hpp"

namespace ph::segment {
namespace {

/// A text of several lines as one line, because strings in JSON contain no line ends.
std::string one_line(std::string_view text) {
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\n') {
      line += text[i];
      continue;
    }
    while (i + 1 < text.size() && text[i + 1] == ' ') ++i;
    if (line.ends_with(',')) line += ' ';
  }
  return line + '\n';
}

std::string failure_line(const std::string& input, int code) {
  return one_line(json::object({{"format", json::string("ph-segment")},
                                {"version", "1"},
                                {"input", json::object({{"path", json::string(input)}})},
                                {"exit_code", json::integer(code)}}));
}

/// The frames of one run, one by one.
class Stream {
 public:
  Stream(const Arguments& arguments, app::Session& session)
      : arguments_(arguments),
        one_(arguments),
        session_(session),
        source_(arguments, session.context()),
        known_(inputs_of(arguments)) {
    if (!arguments.files.any()) {
      throw Error(ErrorKind::usage,
                  "several inputs: found no output for their results, expected one, such as "
                  "--labels FOLDER/ or --json FILE");
    }
    source_.add_known(known_);
    if (!json().path.empty()) {
      if (!arguments.common.force) known_.require_other(json());
      json_.emplace(json().path);
    }
    // This avoids one copy of a long list of inputs per frame.
    one_.inputs = {};
    one_.frames_from.clear();
  }

  int run() {
    while (std::optional<Frame> frame = source_.next()) {
      require_not_json(frame->input);
      segment(std::move(*frame));
      session_.context().poll();
    }
    if (json_) json_->commit();
    if (arguments_.common.force && !replaces_input_)
      session_.explain("--force: not needed, because no output is an input");
    report_throughput();
    return first_failure_;
  }

 private:
  app::Written json() const { return {"--json", arguments_.files.json}; }

  /// Refuses an input that is the file of --json. This file is written at the end and would replace
  /// the input.
  void require_not_json(const std::string& input) {
    if (!json_) return;
    app::InputFiles frame;
    frame.add(input);
    if (!arguments_.common.force) frame.require_other(json());  // mutant: file-frame-json
    replaces_input_ = replaces_input_ || frame.replaced_by(json().path);
  }

  /// Checks that no output replaces an input or another output. @throws Error (usage).
  void require_separate(const Arguments& one) {
    std::vector<app::Written> outputs = one.files.written();
    if (outputs.empty()) return;
    // Called only if needed, because a stream may be endless.
    known_.add(one.input);
    if (json_) outputs.push_back(json());  // mutant: file-stream-json
    if (app::require_separate(known_, outputs, arguments_.common.force)) replaces_input_ = true;
  }

  /// @throws Error if the other frames need not be tried.
  void segment(Frame&& frame) {
    Arguments& one = one_;
    one.input = std::move(frame.input);
    one.files = std::move(frame.files);
    ++frames_;
    int code = app::kOk;
    std::string line;
    try {
      app::require_given("--frames-from", one.input);
      require_separate(one);
      const OfStream stream{arguments_.stable_labels ? &remembered_ : nullptr, json_.has_value()};
      const Outcome outcome = run_frame(one, session_, &stream);
      code = outcome.code;
      line = one_line(outcome.json);
      session_.note(fmt::format("{}: {}", printable(one.input), outcome.summary));
    } catch (const BrokenPipe&) {
      throw;
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::cancelled) throw;
      const bool named = error.message().is_about(printable(one.input));
      code = app::report_current_exception(kProgram, named ? "" : printable(one.input));
      line = failure_line(one.input, code);
    } catch (...) {
      code = app::report_current_exception(kProgram, printable(one.input));
      line = failure_line(one.input, code);
    }
    if (json_) {
      json_->write(line);
      json_->file().flush();
    }
    if (code == app::kOk) return;
    if (first_failure_ == app::kOk) first_failure_ = code;
    ++failures_;
  }

  void report_throughput() const {
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double cpu = static_cast<double>(std::clock() - cpu_start_) / CLOCKS_PER_SEC;
    const auto frames = static_cast<double>(std::max<std::size_t>(frames_, 1));
    if (failures_ > 0) session_.note(fmt::format("{} of {} frames failed", failures_, frames_));
    session_.note(fmt::format("{} frames in {:.2f} s: {:.1f} frames/s, {:.1f} ms CPU per frame",
                              frames_, seconds, frames_ == 0 ? 0 : frames / seconds,
                              1e3 * cpu / frames));
  }

  const Arguments& arguments_;
  Arguments one_;  // the arguments for the current frame
  app::Session& session_;
  FrameSource source_;
  // The inputs known so far, including the names that a pipe has delivered.
  app::InputFiles known_;
  bool replaces_input_ = false;
  std::optional<app::Output> json_;
  Remembered remembered_;
  std::size_t frames_ = 0, failures_ = 0;
  int first_failure_ = app::kOk;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::clock_t cpu_start_ = std::clock();
};

}  // namespace

int run_stream(const Arguments& arguments, app::Session& session) {
  return Stream(arguments, session).run();
}

}  // namespace ph::segment
