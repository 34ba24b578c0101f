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

/// Who is told what is not in plain sight.
using Note = std::function<void(const Message&)>;

/// The camera that has a name, with a note that its values are nominal; nothing if there is none.
std::optional<Camera> camera_named(std::string_view name, const Note& note);

/// The camera of a calibration file, with a note if it has a lens.
/// @throws Error as ph::read_camera does.
Camera calibrated_camera(const std::string& path, const Note& note, const RunContext& context);

/// The cloud of a depth image, with notes on a camera that was scaled to the image and on pixels
/// that are holes for a reason.
/// @param calibration the name or file of the camera; empty: it was given by numbers.
/// @param scale depth units a metre; none: as the image suggests.
/// @throws Error (usage) if the camera is of images of another shape; and as ph::cloud_from_depth.
Cloud cloud_of_depth(const DepthImage& image, const std::optional<Raster>& colour,
                     const Camera& camera, std::string_view calibration,
                     std::optional<double> scale, const Note& note);

}  // namespace ph::segment
