// SPDX-License-Identifier: MIT
#include "cut.hpp"

#include "components.hpp"
#include "meetings.hpp"
#include "methods.hpp"
#include "options.hpp"

namespace ph::segment {

SceneCut cut_scene(const SceneTree& scene, const VoxelGrid& grid, const Surface& surface,
                   const CutOptions& options) {
  std::vector<Index> component_of;
  if (scene.method == Method::paper) {
    // Section V.C: the sets joined to 0-simplices of infinite persistence. At the distance of the
    // complex every merge is done.
    component_of = scene.tree.components(options.value);
  } else {
    component_of = scene.tree.basins(options.value, options.min_part);
    if (options.objects) {
      component_of = join_parts(grid, surface, scene.voxel, component_of, options.min_size);
    }
  }
  SceneCut result = extract_components(scene, component_of, options.min_size);
  find_neighbours(scene.tree, result);
  return result;
}

SceneCut cut(const SceneTree& scene, const CutOptions& options, const RunContext& context) {
  validate(scene, options);
  context.poll();
  if (scene.method == Method::paper || !options.objects) return cut_scene(scene, {}, {}, options);
  const VoxelGrid grid{scene.cells, scene.vertices, scene.counts, {}};
  return cut_scene(scene, grid,
                   {scene.normals, near_voxels(grid, scene.voxel), scene.viewpoint, scene.plane},
                   options);
}

}  // namespace ph::segment
