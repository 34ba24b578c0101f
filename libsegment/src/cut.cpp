// SPDX-License-Identifier: MIT
#include "libsegment/src/methods.hpp"

#include <algorithm>
#include <utility>

#include "libsegment/src/objects/stages.hpp"
#include "libsegment/src/scene/options.hpp"
#include "libsegment/src/supports/containers.hpp"
#include "libsegment/src/supports/stages.hpp"
#include "libsegment/src/voxels/rips_graph.hpp"
#include "ph/detail/metric/pairs_within.hpp"

namespace ph::segment {
namespace {

/// For each pair of segments, the value at which they first meet. If two segments have many edges
/// between them, only the first edge counts.
Contacts contacts_of(const SceneTree& scene, const Surface& surface, const CutOptions& options,
                     const SceneCut& cut, const RunContext& context) {
  Contacts contacts(&context.memory);
  const auto are_apart = [&](std::size_t u, std::size_t v) {
    const std::uint32_t a = cut.vertex_labels[u], b = cut.vertex_labels[v];
    return a != b && a != 0 && b != 0;
  };
  const auto meet = [&](std::size_t u, std::size_t v, double value) {
    const auto labels = std::minmax(cut.vertex_labels[u], cut.vertex_labels[v]);
    const auto [known, is_new] = contacts.try_emplace(labels, value);
    if (!is_new) known->second = std::min(known->second, value);
  };
  if (scene.method != Method::paper) {
    for (const VoxelPair& p : surface.pairs)
      if (are_apart(p.u, p.v) && p.distance < adjacent_radius(scene.voxel))
        meet(p.u, p.v, std::max(scene.merge_tree.births[p.u], scene.merge_tree.births[p.v]));
  } else if (options.value < scene.distance) {  // otherwise, no edge joins two components
    for_each_pair_within(
        scene.vertices, scene.distance,
        [&](Index i, Index j, double length) {
          const auto u = static_cast<std::size_t>(i), v = static_cast<std::size_t>(j);
          if (are_apart(u, v)) meet(u, v, filtration_value(length, scene.distance, scene.steps));
        },
        context);
  }
  return contacts;
}

}  // namespace

Components components_of(const SceneTree& scene, const VoxelGrid& grid, const Surface& surface,
                         const CutOptions& options, const RunContext& context) {
  // Section V.C of the paper: the sets joined to 0-simplices of infinite persistence. If the cut is
  // at the largest distance of the complex, every merge is performed.
  if (scene.method == Method::paper) return {scene.merge_tree.components(options.value)};
  std::vector<Index> component_of = scene.merge_tree.basins(options.value, options.min_part);
  if (scene.method == Method::supervoxels) return {std::move(component_of)};
  if (!options.objects) return {std::move(component_of)};
  Components objects{
      join_parts(grid, surface, scene.voxel, component_of, options.min_size, context)};
  objects.containers = join_containers(scene, surface, options.min_size, objects.of);
  return objects;
}

SceneCut cut_into(const SceneTree& scene, const Components& components, const Surface& surface,
                  const CutOptions& options, const RunContext& context) {
  SceneCut result = extract_components(scene, components.of, options.min_size);
  find_neighbours(scene.merge_tree, contacts_of(scene, surface, options, result, context), result);
  find_what_it_stands_on(scene, surface.pairs, result);
  set_containers(components.containers, result);
  return result;
}

SceneCut cut(const SceneTree& scene, const CutOptions& options, const RunContext& context) {
  validate(scene, options);
  context.poll();
  const VoxelGrid grid{scene.cells, scene.vertices, scene.counts, {}};
  Surface surface;
  if (scene.method != Method::paper)
    surface = {scene.normals, near_voxels(grid, scene.voxel, context), scene.viewpoint,
               scene.plane};
  return cut_into(scene, components_of(scene, grid, surface, options, context), surface, options,
                  context);
}

}  // namespace ph::segment
