// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ph/detail/io/camera.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// How a depth image became a cloud.
struct DepthSource {
  const Camera& camera;
  std::string_view option;  ///< that the camera came from: --intrinsics, --camera
};

/// What a user should know before trusting the result, a line each: what the check found, no plane,
/// units or a camera that cannot be meant. Options have the names that ph-segment gives them.
/// @param cloud null: a stored tree was cut. @param depth null: the cloud was none.
std::vector<std::string> notes(const Segmentation& segmentation, const SegmentOptions& options,
                               const Cloud* cloud, const DepthSource* depth);

}  // namespace ph::segment
