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

/// Runs ph-segment after its command line was parsed. Results are written to files or standard
/// output.
/// @return the exit code. @throws Error.
int run(Arguments& arguments, app::Session& session);

/// Segments frame after frame. A frame that fails does not stop the other frames. Its error is
/// printed to stderr, and the exit code of the first failure is returned at the end. The last line
/// on stderr is the throughput.
int run_stream(const Arguments& arguments, app::Session& session);

/// The state that is kept from frame to frame, to prevent jumps in the results.
struct Remembered {
  LabelTracker tracker;
  /// The last frame with a plane, of which only the plane and the viewpoint are set.
  SceneTree last = {};
};
/// The data that a stream passes along with each frame.
struct OfStream {
  /// If null, frames do not influence one another.
  Remembered* remembered = nullptr;
  bool json = false;  ///< true if the summary is needed
};
/// The outcome of one input.
struct Outcome {
  int code;             ///< the exit code
  std::string summary;  ///< one line for people
  std::string json;     ///< the JSON that --json writes; empty if it is not requested
};
/// Reads `arguments.input`, segments it and writes `arguments.files`.
/// @param stream null if this is the only input. @throws Error.
Outcome run_frame(const Arguments& arguments, app::Session& session, const OfStream* stream);

}  // namespace ph::segment
