// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/detail/io/camera.hpp"
#include "ph/error.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// How a depth image became a cloud.
struct DepthSource {
  const Camera& camera;
  Setting setting;  ///< Setting::intrinsics or Setting::camera, whichever the camera came from
};

/// As the function in ph/segment.hpp, with notes on the camera of a depth image.
/// @param cloud null: a stored tree was cut. @param depth null: the input was not a depth image.
std::vector<Message> notes(const Segmentation& segmentation, const SegmentOptions& options,
                           const Cloud* cloud, const DepthSource* depth);

}  // namespace ph::segment
