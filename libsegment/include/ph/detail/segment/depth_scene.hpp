// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "ph/detail/io/camera.hpp"
#include "ph/error.hpp"
#include "ph/io/cloud.hpp"
#include "ph/run_context.hpp"

namespace ph::segment {

/// A function that receives notes on assumptions that the user should know.
using Note = std::function<void(const Message&)>;

/// The camera with this name, with a note that its values are nominal; empty if no camera has this
/// name.
std::optional<Camera> camera_named(std::string_view name, const Note& note);

/// The camera of a calibration file, with a note if it describes a lens.
/// @throws Error like ph::read_camera.
Camera calibrated_camera(const std::string& path, const Note& note, const RunContext& context);

/// The cloud of a depth image, with notes on a camera that was scaled to the image, on depths that
/// look like grey, and on pixels that became holes.
/// @param calibration the name or file of the camera; empty: it was given as numbers.
/// @param given depth units per metre; empty: the camera's, or guessed from the image.
/// @throws Error (usage) if the camera's images have another shape; else like ph::cloud_from_depth.
Cloud cloud_of_depth(const DepthImage& image, const std::optional<Raster>& colour,
                     const Camera& camera, std::string_view calibration,
                     std::optional<double> given, const Note& note);

}  // namespace ph::segment
