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
  /// The points below the upper support; only they can stand on this support.
  std::vector<Index> points;
};

/// The largest plane below a support. Empty unless the plane is parallel to the support and hardly
/// any point of the whole cloud is below it.
/// @param points the points in range, without holes. @param least_margin the least
/// PlaneMargin::noise of the plane that is found.
std::optional<LowerSupport> find_lower_support(const CloudView& cloud,
                                               const std::vector<Index>& points, const Plane& upper,
                                               double least_margin);

/// Determines what each segment stands on. A segment stands on a removed support if it reaches down
/// to it, that is, if some of its points are as low as this support. It stands on a support among
/// the components if it touches this support. Otherwise it stands on the segment that it touches
/// most among those that it touches at its own lower end but not at their lower ends.
/// @param pairs pairs of voxels that are near each other.
void find_what_it_stands_on(const SceneTree& scene, std::span<const VoxelPair> pairs,
                            SceneCut& cut);

}  // namespace ph::segment
