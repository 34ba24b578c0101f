// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "ph/segment.hpp"

namespace ph::segment {

/// Of a component, on the plane of the surface that it is.
inline constexpr double kLeastShareOnSurface = 0.85;

/// What bounds the scene among the components of a cut, and is no object. A wall is flat, it is not
/// parallel to the support, and nothing of the whole frame is seen behind its plane; behind the
/// face of a box one sees what the box stands on. A further support is flat, parallel to the
/// support, and larger than what is lifted.
/// @param cloud all of it counts, what is out of range too. @param component_of each vertex: one
/// of the vertices of its component. @param min_size fewest voxels of one that is looked at.
/// O(voxels + points for each flat component that is not parallel to the support).
std::vector<SceneSurface> find_bounds(const CloudView& cloud, const Plane& support,
                                      const SceneTree& scene,
                                      const std::vector<Index>& component_of, Index min_size);

/// The number of the surface, from 1, that a component lies on with nearly all of its voxels, by
/// vertex that names the component; 0: none. Looks at components of `min_size` voxels and more.
std::vector<std::uint8_t> surfaces_of(const SceneTree& scene,
                                      const std::vector<Index>& component_of, Index min_size);

/// How many voxels of each group lie on each surface that was found among the components, group
/// after group: what decides for any union of groups. @param group_of each vertex, from 0.
std::vector<std::uint32_t> voxels_on_surfaces(const SceneTree& scene,
                                              std::span<const std::uint32_t> group_of,
                                              std::size_t groups);

}  // namespace ph::segment
