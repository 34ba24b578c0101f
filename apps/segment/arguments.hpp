// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cloud_picture.hpp"
#include "command_line.hpp"
#include "file_identity.hpp"
#include "option_scope.hpp"
#include "ph/io/cloud_io.hpp"
#include "ph/segment.hpp"
#include "plot_arguments.hpp"

namespace ph::segment {

/// A depth image with what is needed to make a cloud of it.
struct DepthInput {
  std::string depth;
  std::string colour;            ///< empty: none
  std::string calibration;       ///< --camera: a file, or a name; empty: none
  std::optional<Camera> camera;  ///< of --intrinsics, or what `calibration` holds
  std::optional<double> scale;   ///< depth units a metre; none: as the image suggests

  bool has_camera() const { return camera || !calibration.empty(); }
};

/// The files to write. An empty path: not asked for.
struct OutputPaths {
  std::string output;            ///< the cloud with its labels
  std::string labels;            ///< one label a point
  std::string json;              ///< the summary
  std::string tree;              ///< the merge tree
  std::string barcode;           ///< H0
  std::string coloured;          ///< the cloud with a colour a segment
  std::string picture;           ///< the image with a colour a segment
  std::string report;            ///< the page to look at
  std::vector<app::Plot> plots;  ///< figures of what is in it
  PlotOptions look = {};         ///< of the figures

  std::vector<const std::string*> all() const {
    std::vector<const std::string*> paths{&output, &labels, &json, &tree, &barcode};
    for (const app::Plot& plot : plots) paths.push_back(&plot.path);
    paths.insert(paths.end(), {&coloured, &picture, &report});
    return paths;
  }
  /// Those that are asked for, with their options.
  std::vector<app::Written> written() const {
    std::vector<app::Written> files;
    const auto add = [&](std::string_view option, const std::string& path) {
      if (!path.empty()) files.push_back({option, path});
    };
    add("--output", output);
    add("--labels", labels);
    add("--json", json);
    add("--tree", tree);
    add("--barcode", barcode);
    for (const app::Plot& plot : plots) add("--plot", plot.path);
    add("--coloured", coloured);
    add("--picture", picture);
    add("--report", report);
    return files;
  }
  /// Those that a stream has for each of its frames, and that are asked for.
  std::vector<std::string> of_each_frame() const {
    std::vector<std::string> paths;
    for (const std::string* path : all())
      if (path != &json && !path->empty()) paths.push_back(*path);
    return paths;
  }
  bool any() const {
    return std::ranges::any_of(all(), [](const std::string* path) { return !path->empty(); });
  }
  bool to_standard_output() const {
    return std::ranges::any_of(all(), [](const std::string* path) { return *path == "-"; });
  }
};

/// What the command line says of the cut.
struct CutArguments {
  std::optional<double> value;
  std::optional<Index> min_part, min_size;
  std::optional<bool> objects;

  /// The rest as the tree has it.
  CutOptions over(const CutOptions& tree) const {
    return {value.value_or(tree.value), min_part.value_or(tree.min_part),
            min_size.value_or(tree.min_size), objects.value_or(tree.objects)};
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

/// Reads the command line; prints nothing.
/// @return the answer to --help or --version, which is all that is left to do.
/// @throws Error (usage); Error (not_built_in) on what is planned but not there.
std::optional<std::string> parse_arguments(int argc, const char* const* argv, Arguments& arguments);

}  // namespace ph::segment
