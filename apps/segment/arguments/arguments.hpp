// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/arguments/command_line.hpp"
#include "apps/common/arguments/option_scope.hpp"
#include "apps/common/files/file_identity.hpp"
#include "apps/common/manual/manual.hpp"
#include "apps/segment/arguments/output_paths.hpp"
#include "ph/detail/segment/cloud_picture.hpp"
#include "ph/io/cloud.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// A depth image with the data that turn it into a cloud.
struct DepthInput {
  std::string depth;
  std::string colour;  ///< empty if there is none
  /// The value of --camera, which is a file or a name; empty if there is none.
  std::string calibration;
  /// The value of --intrinsics, or the content of `calibration`.
  std::optional<Camera> camera;
  /// The number of units per metre, of the depth or of the coordinates of a cloud. If there is
  /// none, it is guessed from the image; a cloud is in metres.
  std::optional<double> scale;

  bool has_camera() const { return camera || !calibration.empty(); }
  /// The file or name that --camera gives. Empty if --camera is not given.
  std::string calibration_file() const;
};

/// The options for the cut.
struct CutArguments {
  std::optional<double> value;
  std::optional<Index> min_part, min_size;
  std::optional<bool> objects;

  /// The options of a cut. Where no value is given, the value of the tree is used.
  CutOptions over(const CutOptions& tree) const {
    return {value.value_or(tree.value), min_part.value_or(tree.min_part),
            min_size.value_or(tree.min_size), objects.value_or(tree.objects)};
  }
};

/// The command line of ph-segment.
struct Arguments {
  std::vector<std::string> inputs;  ///< the inputs as given, which are files or folders of frames
  /// A list of frames, one per line; empty if there is none.
  std::string frames_from;
  /// True if an object keeps its label from frame to frame.
  bool stable_labels = false;
  /// The current input, which is a cloud or a stored tree. If it is empty, the input is
  /// image.depth.
  std::string input;
  DepthInput image;
  /// True if a cloud without points is an empty result instead of an error.
  bool allow_empty = false;
  SegmentOptions options;
  CutArguments cut;
  /// The given options that have no effect for some inputs or methods.
  std::vector<app::GivenOption> given;
  OutputPaths files;
  ViewTurn plot_view;  ///< the view of a plot that shows the cloud
  /// True if the homology of each segment is written into the JSON.
  bool signatures = false;
  /// Two segments for which the program prints where they join.
  std::optional<std::array<std::uint32_t, 2>> explain;
  app::CommonOptions common;
  // These members are for the report. They are the command line as it was typed, and its options
  // except the options for the cut and the outputs.
  std::vector<std::string> command, scene_options;

  /// True if frames are read and folders of results are written.
  bool is_stream() const;
  /// True if `input` is a depth image, or `image` has one.
  bool is_depth_image() const;
};

/// The files that are read, except frames in folders and lists. No output may replace them.
app::InputFiles inputs_of(const Arguments& arguments);

/// Reads the command line, and prints nothing.
/// @return the answer to --help or --version, if one of these options was given.
/// @throws Error (usage); Error (not_built_in) on planned features.
std::optional<std::string> parse_arguments(int argc, const char* const* argv, Arguments& arguments);

/// One line for each given option that has no effect on any requested result. Options that have no
/// effect for an input or a method are refused instead (see scopes.hpp).
std::vector<std::string> idle_options(const Arguments& arguments);

/// The manual of the program.
const app::Manual& manual();

}  // namespace ph::segment
