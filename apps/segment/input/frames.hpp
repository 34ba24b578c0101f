// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "segment/arguments/arguments.hpp"
#include "segment/input/frame_list.hpp"

namespace ph::segment {

/// One of several inputs, and where its results go.
struct Frame {
  std::string input;
  OutputPaths files;
};

/// The frames of a stream, one after the other: inputs, the files of folders by name, and then the
/// lines of a list, each as soon as it is there.
class FrameSource {
 public:
  /// Creates the folders of the outputs. @throws Error (usage) if the files of two frames would be
  /// the same or an output is no folder and has no `*`; Error (no_input); Error (cannot_create).
  FrameSource(const Arguments& arguments, const RunContext& context);

  /// Adds the frames that are known before the first one is asked for: all but those of a list that
  /// can be read once only, a pipe, which may have no end.
  void add_known(app::InputFiles& known);
  /// @return none: that was all. @throws Error as FrameList::next.
  std::optional<Frame> next();

 private:
  void take_names();
  /// @throws Error (usage) if a file is one of a frame before it.
  void take_files(const OutputPaths& files);
  std::string name_of(const std::string& input);

  const OutputPaths& patterns_;
  bool has_files_;  // each frame has files: names matter
  std::vector<std::string> inputs_, names_;
  std::size_t given_ = 0;
  std::optional<FrameList> list_;
  // Names that are taken, each with the number behind the last one that was made of it. Without
  // files none is: a stream may go on for ever.
  std::unordered_map<std::string, std::size_t> taken_;
  // Those of all frames, where each frame has several: a `*` in two of them may stand for different
  // names, such as a-2 in `*.npy` and a in `*-2.npy`.
  std::unordered_set<std::string> taken_files_;
};

}  // namespace ph::segment
