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

/// The direction of view: the eye moves around the middle of the segments, starting where the
/// sensor stood, first to the right (about the normal of the plane if one was removed) and then up.
/// Both angles are in degrees.
struct ViewTurn {
  double right = 0;
  double up = 0;
};

/// The visible points of a scene.
struct CloudPicture {
  Raster raster;
  /// The number of points in no segment (at 0), then in each segment; holes do not count.
  std::vector<std::size_t> points;
  /// For each segment, the pixel where its number may be drawn; empty for a segment that is hardly
  /// visible.
  std::vector<std::optional<std::array<double, 2>>> middles;
};

/// A colour as it appears in the picture where the scene is of medium brightness. @param colour
/// empty: the colour of points in no segment.
std::uint32_t colour_in_picture(std::optional<std::uint32_t> colour);

/// A picture of a scene, RGB, at most 1040 pixels per side (88 mm at 300 dots per inch). Segments
/// have their colours, all other points are light grey, and hidden points are left out. The
/// segments fill the picture; the eye is as far away as the sensor was.
/// @param cloud null: only the points that have a vertex exist.
/// @param colours of each segment, 0x00RRGGBB. @throws Error (resource).
CloudPicture cloud_picture(const Cloud* cloud, const SceneTree& scene,
                           std::span<const std::uint32_t> labels,
                           std::span<const std::uint32_t> colours, const ViewTurn& turn,
                           const RunContext& context);

}  // namespace ph::segment
