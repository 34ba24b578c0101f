// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "common/run/program.hpp"
#include "common/run/session.hpp"
#include "ph/label_tracker.hpp"
#include "segment/arguments/arguments.hpp"

namespace ph::segment {

inline constexpr app::Program kProgram{"ph-segment", "use fewer points, or raise --memory-limit"};

/// Runs ph-segment, once its command line is read; results go to files or standard output.
/// @return the exit code. @throws Error.
int run(Arguments& arguments, app::Session& session);

/// Segments frame after frame. One failure does not stop the others: its line goes to stderr and
/// the code of the first one is returned at the end. The last line on stderr is the throughput.
int run_stream(const Arguments& arguments, app::Session& session);

/// What is remembered from frame to frame so that results are steady.
struct Remembered {
  LabelTracker tracker;
  SceneTree last = {};  ///< of the last frame with a plane: its plane and its viewpoint, no more
};
/// What a stream wants of one of its frames.
struct OfStream {
  Remembered* remembered = nullptr;  ///< null: each frame by itself
  bool json = false;                 ///< whether to give the summary
};
/// What became of one input.
struct Outcome {
  int code;             ///< exit code
  std::string summary;  ///< one line for people
  std::string json;     ///< as --json has it; empty: not asked for
};
/// Reads `arguments.input`, segments it and writes `arguments.files`.
/// @param stream null: the only input. @throws Error.
Outcome run_frame(const Arguments& arguments, app::Session& session, const OfStream* stream);

}  // namespace ph::segment
