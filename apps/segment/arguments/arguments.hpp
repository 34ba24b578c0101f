// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/arguments/command_line.hpp"
#include "common/arguments/option_scope.hpp"
#include "common/files/file_identity.hpp"
#include "ph/io/cloud.hpp"
#include "ph/segment.hpp"
#include "pictures/cloud_picture.hpp"
#include "segment/arguments/output_paths.hpp"

namespace ph::segment {

/// A depth image with what is needed to make a cloud of it.
struct DepthInput {
  std::string depth;
  std::string colour;            ///< empty: none
  std::string calibration;       ///< --camera: a file, or a name; empty: none
  std::optional<Camera> camera;  ///< of --intrinsics, or what `calibration` holds
  std::optional<double> scale;   ///< depth units a metre; none: as the image suggests

  bool has_camera() const { return camera || !calibration.empty(); }
  /// What --camera reads; empty: nothing.
  std::string calibration_file() const;
};

/// What the command line says of the cut.
struct CutArguments {
  std::optional<double> value;
  std::optional<Index> min_part, min_size;
  std::optional<bool> objects;
  std::optional<double> min_seam;

  /// The rest as the tree has it.
  CutOptions over(const CutOptions& tree) const {
    return {value.value_or(tree.value), min_part.value_or(tree.min_part),
            min_size.value_or(tree.min_size), objects.value_or(tree.objects),
            min_seam.value_or(tree.min_seam)};
  }
};

/// The command line of ph-segment.
struct Arguments {
  std::vector<std::string> inputs;  ///< as given: files, or folders of frames
  std::string frames_from;          ///< a list of frames, one a line; empty: none
  bool stable_labels = false;       ///< an object keeps its label from frame to frame
  std::string input;  ///< the one that is looked at: a cloud or a stored tree; empty: image.depth
  DepthInput image;
  bool allow_empty = false;  ///< a cloud without points is an empty result, not an error
  SegmentOptions options;
  CutArguments cut;
  /// The options that were given of those that do nothing for some inputs or methods.
  std::vector<const app::OptionScope*> given;
  OutputPaths files;
  ViewTurn plot_view;       ///< of a plot that shows the cloud
  bool signatures = false;  ///< the homology of each segment goes into the JSON
  std::optional<std::array<std::uint32_t, 2>> explain;  ///< two segments: where do they join?
  app::CommonOptions common;
  // For the report: the command line as it was typed, and its options without those that say where
  // to cut and what to write.
  std::vector<std::string> command, scene_options;

  /// Whether frames go in and folders of results come out.
  bool is_stream() const;
  /// Whether `input` is a depth image, or `image` has one.
  bool is_depth_image() const;
};

/// What is read, but for frames in folders and in lists: no output may replace it.
app::InputFiles inputs_of(const Arguments& arguments);

/// Reads the command line; prints nothing.
/// @return the answer to --help or --version, which is all that is left to do.
/// @throws Error (usage); Error (not_built_in) on what is planned but not there.
std::optional<std::string> parse_arguments(int argc, const char* const* argv, Arguments& arguments);

/// The options that do nothing beside the others, a line each: what is asked for has no use for
/// them. Those that do nothing for an input or a method are refused, see option_scopes.hpp.
std::vector<std::string> idle_options(const Arguments& arguments);

}  // namespace ph::segment
