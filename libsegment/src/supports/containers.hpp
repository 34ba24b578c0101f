// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "libsegment/src/objects/objects.hpp"
#include "ph/scene_tree.hpp"

namespace ph::segment {

/// Finds bins, trays and other containers, and joins the floor of each container with its walls.
/// A floor is a part with walls or an object with an opening: the convex hull around it, seen along
/// the normal of the support, holds the middles of at least three other objects between its lower
/// and its upper end. A wall of a floor is a flat, steep part that touches the floor, and nothing
/// of the floor is behind it.
/// @param object_of for each voxel, one of the voxels of its object. The walls of a container get
/// the number of its floor. @param min_size the fewest voxels of an object.
/// @return one voxel of each container. Takes O(voxels + objects²) time.
std::vector<Index> join_containers(const SceneTree& scene, const Surface& surface, Index min_size,
                                   std::vector<Index>& object_of);

}  // namespace ph::segment
