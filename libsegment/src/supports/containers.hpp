// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "libsegment/src/objects/objects.hpp"
#include "ph/scene_tree.hpp"

namespace ph::segment {

/// A bin, a tray with a rim, or another segment with objects in it.
struct Container {
  Index vertex;                ///< one of its voxels
  std::vector<Index> objects;  ///< one voxel of each object in it
};

/// Finds containers, and joins the floor of each container with its walls. A floor is a part with
/// walls, or an object with an opening: the convex hull around floor and walls, seen along the
/// normal of the support, contains the middles of at least three other objects, and these middles
/// lie between the lower and the upper end. A wall of a floor is a flat, steep part that touches
/// the floor, and nothing of the floor is behind it. If the walls are one part, this part counts as
/// the floor, and a flat part that covers most of the hull belongs to it. So do flat, steep parts
/// along the border of the hull, which are outsides of walls.
/// @param object_of for each voxel, one of the voxels of its object. The walls of a container get
/// the number of its floor. @param min_size the fewest voxels of an object.
/// @return the containers, largest first. Takes O(voxels log voxels) time, plus time for
/// the objects within the extent of each object along one axis.
std::vector<Container> join_containers(const SceneTree& scene, const Surface& surface,
                                       Index min_size, std::vector<Index>& object_of);

/// Sets the role of containers, and what the objects in them stand on unless it is another object.
void set_containers(std::span<const Container> containers, SceneCut& cut);

}  // namespace ph::segment
