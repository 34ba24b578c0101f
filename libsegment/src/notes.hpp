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
  Setting setting;  ///< that the camera came from: Setting::intrinsics or Setting::camera
};

/// What a user should know before trusting the result, a line each: what the check found, no plane,
/// units or a camera that cannot be meant.
/// @param cloud null: a stored tree was cut. @param depth null: the cloud was none.
std::vector<Message> notes(const Segmentation& segmentation, const SegmentOptions& options,
                           const Cloud* cloud, const DepthSource* depth);

}  // namespace ph::segment
