// SPDX-License-Identifier: MIT
#pragma once
#include "objects/objects.hpp"
#include "ph/scene_tree.hpp"

namespace ph::segment {

/// The components that a cut leaves, including small ones: for each vertex, one of the vertices of
/// its component. Reads the method, the voxel and the tree from `scene`.
/// @param grid its centroids are the vertices. @param surface empty in method paper.
std::vector<Index> components_of(const SceneTree& scene, const VoxelGrid& grid,
                                 const Surface& surface, const CutOptions& options,
                                 const RunContext& context);

/// The segments that components make.
SceneCut cut_into(const SceneTree& scene, const std::vector<Index>& component_of,
                  const Surface& surface, const CutOptions& options, const RunContext& context);

}  // namespace ph::segment
