// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "ph/segment.hpp"

namespace ph::segment {

/// The least share of a component's voxels that lie on the plane of its surface.
inline constexpr double kLeastShareOnSurface = 0.85;

/// The components of a cut that are walls or ceilings, because they are smaller than the ones that
/// were removed from the points. A wall is flat, is steep (at an angle of more than 60 degrees to
/// the support), and the frame shows nearly nothing behind its plane. In contrast, behind the plane
/// of a box's face, the frame shows what the box stands on. A ceiling is flat, faces the support,
/// and has nearly nothing behind it.
/// @param cloud all points count, even points out of range. @param component_of for each vertex,
/// one of the vertices of its component. @param min_size fewest voxels of an examined component.
/// Takes O(voxels + points for each flat and steep component) time.
std::vector<SceneSurface> find_bounds(const CloudView& cloud, const Plane& support,
                                      const SceneTree& scene,
                                      const std::vector<Index>& component_of, Index min_size);

/// For each vertex that names a component, the number, from 1, of the surface on which nearly all
/// voxels of the component lie; 0: none. Examines components of `min_size` voxels and more.
std::vector<std::uint8_t> surfaces_of(const SceneTree& scene,
                                      const std::vector<Index>& component_of, Index min_size);

/// The number of voxels of each group on each surface that was found among the components, group
/// after group. These numbers suffice for any union of groups. @param group_of the group of each
/// vertex, counted from 0.
std::vector<std::uint32_t> voxels_on_surfaces(const SceneTree& scene,
                                              std::span<const std::uint32_t> group_of,
                                              std::size_t groups);

}  // namespace ph::segment
