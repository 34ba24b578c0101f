// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/voxels/voxel_pairs.hpp"
#include "ph/scene_tree.hpp"

namespace ph::segment {

/// A support below another support, for example the floor or a drawer below a table.
struct LowerSupport {
  Plane plane;
  PlaneMargin margin;
  std::vector<Index> points;  ///< below the upper support: all that can stand on this one
};

/// The largest plane below a support if it is parallel to the support and nothing of the whole
/// frame is visible below it.
/// @param points the points in range, without holes. @param least_margin of the plane that is
/// found, as PlaneMargin::noise.
std::optional<LowerSupport> find_lower_support(const CloudView& cloud,
                                               const std::vector<Index>& points, const Plane& upper,
                                               double least_margin);

/// Determines for each segment what it stands on, and whether it is an object or may be one. A
/// segment stands on a support if it reaches it: some of its points lie over the support and as
/// low. Otherwise it stands on the segment that it touches most at its own lower end, unless this
/// is also the lower end of the other segment. A segment that stands on nothing visible is an
/// object as well, unless the border of an organised cloud cuts it off: then its role is unknown.
/// @param pairs of voxels that are near each other. Does nothing if there is no support.
void find_what_it_stands_on(const SceneTree& scene, std::span<const VoxelPair> pairs,
                            SceneCut& cut);

}  // namespace ph::segment
