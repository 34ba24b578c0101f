// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "apps/common/run/program.hpp"
#include "apps/common/run/session.hpp"
#include "apps/segment/arguments/arguments.hpp"
#include "ph/label_tracker.hpp"

namespace ph::segment {

// mutant: segment-memory
inline constexpr app::Program kProgram{"ph-segment", "use fewer points, or raise --memory-limit"};

/// Runs ph-segment after its command line was parsed; results go to files or standard output.
/// @return the exit code. @throws Error.
int run(Arguments& arguments, app::Session& session);

/// Segments frame after frame. A frame that fails does not stop the others: its error is printed to
/// stderr, and the exit code of the first failure is returned at the end. The last line on stderr
/// is the throughput.
int run_stream(const Arguments& arguments, app::Session& session);

/// The state that is kept from frame to frame so that results are steady.
struct Remembered {
  LabelTracker tracker;
  SceneTree last = {};  ///< of the last frame with a plane: only its plane and its viewpoint
};
/// The data that a stream passes along with each frame.
struct OfStream {
  Remembered* remembered = nullptr;  ///< null: frames do not influence one another
  bool json = false;                 ///< true if the summary is needed
};
/// The outcome of one input.
struct Outcome {
  int code;             ///< exit code
  std::string summary;  ///< one line for people
  std::string json;     ///< as --json writes it; empty: not requested
};
/// Reads `arguments.input`, segments it and writes `arguments.files`.
/// @param stream null: this is the only input. @throws Error.
Outcome run_frame(const Arguments& arguments, app::Session& session, const OfStream* stream);

}  // namespace ph::segment
