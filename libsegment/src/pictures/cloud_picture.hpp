// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ph/detail/io/cloud_data.hpp"
#include "ph/detail/io/png.hpp"
#include "ph/run_context.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// Where to look from: the eye goes around the middle of the segments, from where the sensor stood,
/// to the right (about the normal of the plane, where one was removed) and then up. Degrees.
struct ViewTurn {
  double right = 0;
  double up = 0;
};

/// What is seen of a scene.
struct CloudPicture {
  Raster raster;
  /// How many points each segment has, behind those in none (place 0); without holes.
  std::vector<std::size_t> points;
  /// The pixel where the number of each segment may stand; none of one that is hardly seen.
  std::vector<std::optional<std::array<double, 2>>> middles;
};

/// A colour as it is in the picture, where the scene is of medium brightness. @param colour none:
/// in no segment.
std::uint32_t colour_in_picture(std::optional<std::uint32_t> colour);

/// A picture of a scene, RGB, no more than 1040 pixels a side (88 mm at 300 dots an inch): segments
/// in their colours, all else in light grey, what is hidden by something nearer left out. The
/// segments fill it; perspective is that of an eye as far away as the sensor was.
/// @param cloud null: only the points that have a vertex are there.
/// @param colours of each segment, 0x00RRGGBB. @throws Error (resource).
CloudPicture cloud_picture(const Cloud* cloud, const SceneTree& scene,
                           std::span<const std::uint32_t> labels,
                           std::span<const std::uint32_t> colours, const ViewTurn& turn,
                           const RunContext& context);

}  // namespace ph::segment
