// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>

#include "ph/core/run_context.hpp"
#include "ph/io/cloud.hpp"
#include "ph/io/png.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// Where to look from: the eye goes around the middle of the segments, from where the sensor stood,
/// to the right (about the normal of the plane, where one was removed) and then up. Degrees.
struct ViewTurn {
  double right = 0;
  double up = 0;
};

/// A picture of a scene, RGB, no more than 1040 pixels a side (88 mm at 300 dots an inch): segments
/// in their colours, all else in light grey, what is hidden by something nearer left out. The
/// segments fill it; perspective is that of an eye as far away as the sensor was.
/// @param cloud null: only the points that have a vertex are there.
/// @param colours of each segment, 0x00RRGGBB. @throws Error (resource).
Raster cloud_picture(const Cloud* cloud, const SceneTree& scene,
                     std::span<const std::uint32_t> labels, std::span<const std::uint32_t> colours,
                     const ViewTurn& turn, const RunContext& context);

}  // namespace ph::segment
