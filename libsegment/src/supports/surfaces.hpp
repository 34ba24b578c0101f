// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <vector>

#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/plane/sample.hpp"
#include "ph/scene_tree.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// A support that was removed, with the points of its strip (see Cleared).
struct OtherSupport {
  Plane plane;
  PlaneMargin margin;
  std::vector<Index> strip;
};

/// A cloud and its supporting plane. `points` contains the points in range, divided by the plane.
/// Without a plane, all points are in `points.beyond`.
struct Scene {
  CloudView cloud;
  std::optional<Plane> plane;
  PlaneMargin margin;
  double noise = 0, range = 0;  ///< PlaneSearch::noise_along and PlaneSearch::range of the plane
  std::vector<Index> in_range;  ///< all points in range, if there is a plane
  Cleared points;
  std::vector<OtherSupport> others;  ///< the supports that were removed in addition to the plane
  /// points.beyond before boards and walls were removed; empty if there are none
  std::vector<Index> before;
};

/// Adds a surface to a tree, marks the points that were removed with it, and measures their box.
void add_surface(Role role, const Plane& plane, const CloudView& cloud,
                 const std::vector<Index>& points, SceneTree& tree);

/// Removes all surfaces of a scene from its points: the walls, the ceiling, the supporting plane,
/// and the supports that are parallel to it. The objects on the supports stay. The surfaces and
/// their roles are added to the tree, the supporting plane first.
/// @param in_range the points in range. @param planes large planes other than the support.
/// @param sample a sample of the points in range. @param most_supports at least 1.
void clear_surfaces(const std::vector<Index>& in_range, const std::vector<Plane>& planes,
                    const Sample& sample, const PlaneSight& sight, Index most_supports,
                    Scene& scene, SceneTree& tree);

}  // namespace ph::segment
