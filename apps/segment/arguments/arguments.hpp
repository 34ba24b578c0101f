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
  std::string colour;            ///< empty: none
  std::string calibration;       ///< --camera: a file, or a name; empty: none
  std::optional<Camera> camera;  ///< value of --intrinsics, or content of `calibration`
  std::optional<double> scale;   ///< depth units per metre; empty: guessed from the image

  bool has_camera() const { return camera || !calibration.empty(); }
  /// The file or name that --camera gives; empty: none.
  std::string calibration_file() const;
};

/// The options for the cut.
struct CutArguments {
  std::optional<double> value;
  std::optional<Index> min_part, min_size;
  std::optional<bool> objects;
  std::optional<double> min_seam;

  /// The options of a cut: the given values and, where none is given, the values of the tree.
  CutOptions over(const CutOptions& tree) const {
    return {value.value_or(tree.value), min_part.value_or(tree.min_part),
            min_size.value_or(tree.min_size), objects.value_or(tree.objects),
            min_seam.value_or(tree.min_seam)};
  }
};

/// The command line of ph-segment.
struct Arguments {
  std::vector<std::string> inputs;  ///< as given: files, or folders of frames
  std::string frames_from;          ///< a list of frames, one per line; empty: none
  bool stable_labels = false;       ///< an object keeps its label from frame to frame
  std::string input;  ///< the current input: a cloud or a stored tree; empty: image.depth
  DepthInput image;
  bool allow_empty = false;  ///< a cloud without points is an empty result, not an error
  SegmentOptions options;
  CutArguments cut;
  /// The given options that have no effect for some inputs or methods.
  std::vector<app::GivenOption> given;
  OutputPaths files;
  ViewTurn plot_view;       ///< view of a plot that shows the cloud
  bool signatures = false;  ///< write the homology of each segment into the JSON
  std::optional<std::array<std::uint32_t, 2>> explain;  ///< two segments: print where they join
  app::CommonOptions common;
  // For the report: the command line as it was typed, and its options except those for the cut and
  // the outputs.
  std::vector<std::string> command, scene_options;

  /// True if frames are read and folders of results are written.
  bool is_stream() const;
  /// True if `input` is a depth image, or `image` has one.
  bool is_depth_image() const;
};

/// The files that are read, except frames in folders and lists. No output may replace them.
app::InputFiles inputs_of(const Arguments& arguments);

/// Reads the command line; prints nothing.
/// @return the answer to --help or --version, if one was asked for.
/// @throws Error (usage); Error (not_built_in) on planned features.
std::optional<std::string> parse_arguments(int argc, const char* const* argv, Arguments& arguments);

/// One line for each given option that has no effect on any requested result. Options that have no
/// effect for an input or a method are refused instead; see scopes.hpp.
std::vector<std::string> idle_options(const Arguments& arguments);

/// The manual of the program.
const app::Manual& manual();

}  // namespace ph::segment
