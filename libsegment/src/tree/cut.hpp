// SPDX-License-Identifier: MIT
#pragma once
#include "objects/objects.hpp"
#include "ph/scene_tree.hpp"

namespace ph::segment {

/// `cut` with what the pipeline has at hand and `cut` makes anew.
/// @param grid its centroids are the vertices. @param surface empty in method paper.
SceneCut cut_scene(const SceneTree& scene, const VoxelGrid& grid, const Surface& surface,
                   const CutOptions& options, const RunContext& context);

}  // namespace ph::segment
