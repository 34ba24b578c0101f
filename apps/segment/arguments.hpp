// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "command_line.hpp"
#include "ph/io/cloud_io.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// A depth image with what is needed to make a cloud of it.
struct DepthInput {
  std::string depth;
  std::string colour;                    ///< empty: none
  std::optional<Intrinsics> intrinsics;  ///< pixels
  double scale = 1000;                   ///< depth units a metre
};

/// The command line of ph-segment. An empty path: not asked for.
struct Arguments {
  std::string input;  ///< a cloud; empty: the depth image
  DepthInput image;
  bool allow_empty = false;  ///< a cloud without points is an empty result, not an error
  SegmentOptions options;
  std::string output;                                   ///< the cloud with its labels
  std::string labels;                                   ///< one label a point
  std::string json;                                     ///< the summary
  std::string barcode;                                  ///< H0
  std::string plot;                                     ///< the barcode as a figure
  std::string coloured;                                 ///< the cloud with a colour a segment
  std::string picture;                                  ///< the image with a colour a segment
  std::optional<std::array<std::uint32_t, 2>> explain;  ///< two segments: where do they join?
  app::CommonOptions common;

  std::array<const std::string*, 7> files() const {
    return {&output, &labels, &json, &barcode, &plot, &coloured, &picture};
  }
  bool writes_files() const {
    return std::ranges::any_of(files(), [](const std::string* path) { return !path->empty(); });
  }
  bool writes_to_standard_output() const {
    return std::ranges::any_of(files(), [](const std::string* path) { return *path == "-"; });
  }
};

/// Reads the command line; prints nothing.
/// @return the answer to --help or --version, which is all that is left to do.
/// @throws Error (usage); Error (not_built_in) on what is planned but not there.
std::optional<std::string> parse_arguments(int argc, const char* const* argv, Arguments& arguments);

}  // namespace ph::segment
