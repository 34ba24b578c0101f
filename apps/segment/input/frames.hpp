// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "apps/common/run/session.hpp"
#include "apps/segment/arguments/arguments.hpp"
#include "apps/segment/input/frame_list.hpp"

namespace ph::segment {

/// One of several inputs, and the files of its results.
struct Frame {
  std::string input;
  OutputPaths files;
};

/// The frames of a stream, one after another. The inputs come first, where each folder is replaced
/// by its files in the order of their names. Then come the lines of a list, each as soon as it has
/// arrived.
class FrameSource {
 public:
  /// Creates the folders of the outputs. @throws Error (usage) if two frames would have the same
  /// files, or if an output is neither a folder nor has a `*`; Error (no_input); Error
  /// (cannot_create).
  FrameSource(const Arguments& arguments, const RunContext& context);

  /// Adds the frames that are known before the first frame is requested. These are all frames
  /// except the frames that a pipe lists, because a pipe can be read only once and may have no end.
  void add_known(app::InputFiles& known);
  /// @return nothing after the last frame. @throws Error like FrameList::next.
  std::optional<Frame> next();

 private:
  void take_names();
  /// @throws Error (usage) if a file already belongs to an earlier frame.
  void take_files(const OutputPaths& files);
  std::string name_of(const std::string& input);

  const OutputPaths& patterns_;
  bool has_files_;  // true if each frame has output files, for which names matter
  std::vector<std::string> inputs_, names_;
  std::size_t given_ = 0;
  std::optional<FrameList> list_;
  // The names in use, each with the last number that was appended to it. Without output files, the
  // map stays empty, because a stream may be endless.
  std::unordered_map<std::string, std::size_t> taken_;
  // The output files of all frames so far, if each frame has several. Two patterns may give the
  // same file from different names. For example, `*.npy` with a-2 and `*-2.npy` with a give the
  // same file.
  std::unordered_set<std::string> taken_files_;
};

/// Reads the camera that --camera names. Reports facts that are not obvious, such as nominal values
/// or a lens that distorts.
/// @throws Error like ph::read_camera.
void load_camera(DepthInput& image, app::Session& session);

}  // namespace ph::segment
