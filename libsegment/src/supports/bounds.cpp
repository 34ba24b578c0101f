// SPDX-License-Identifier: MIT
#include "ph/detail/segment/bounds.hpp"

#include <algorithm>

#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/scene/parts.hpp"
#include "libsegment/src/supports/planar.hpp"

namespace ph::segment {
namespace {

using Voxels = std::vector<Index>;

/// The voxels of each part.
std::vector<Voxels> voxels_of(const Parts& parts) {
  std::vector<Voxels> voxels(parts.count());
  for (std::size_t v = 0; v < parts.of.size(); ++v)
    if (parts.of[v] != Parts::kSmall) voxels[parts.of[v]].push_back(static_cast<Index>(v));
  return voxels;
}

}  // namespace

std::vector<SceneSurface> find_bounds(const CloudView& cloud, const Plane& support,
                                      const SceneTree& scene,
                                      const std::vector<Index>& component_of, Index min_size) {
  std::vector<SceneSurface> found;
  for (const Voxels& voxels : voxels_of(number_parts(component_of, min_size))) {
    const auto plane = plane_through(scene.vertices, scene.normals, voxels, cloud.viewpoint);
    if (!plane || plane->share < kLeastShareOnSurface) continue;
    if (const auto role = role_of_bound(*plane, support, cloud)) found.push_back({*role, *plane});
    if (scene.surfaces.size() + found.size() == kMostSurfaces) break;
  }
  return found;
}

std::vector<std::uint8_t> surfaces_of(const SceneTree& scene,
                                      const std::vector<Index>& component_of, Index min_size) {
  std::vector<std::uint8_t> surfaces(component_of.size());
  // No component is on the supports that were removed.
  const auto first = static_cast<std::size_t>(scene.removed);
  if (scene.surfaces.size() == first) return surfaces;
  const Parts parts = number_parts(component_of, min_size);
  const std::vector<Voxels> voxels = voxels_of(parts);
  for (std::size_t p = 0; p < parts.count(); ++p) {
    std::uint8_t& surface = surfaces[static_cast<std::size_t>(component_of[parts.example[p]])];
    for (std::size_t s = first; s < scene.surfaces.size() && surface == 0; ++s)
      if (share_on(scene.surfaces[s].plane, scene.vertices, voxels[p], scene.viewpoint) >=
          kLeastShareOnSurface)
        surface = static_cast<std::uint8_t>(s + 1);
  }
  return surfaces;
}

std::vector<std::uint32_t> voxels_on_surfaces(const SceneTree& scene,
                                              std::span<const std::uint32_t> group_of,
                                              std::size_t groups) {
  const auto first = static_cast<std::size_t>(scene.removed);
  std::vector<Voxels> voxels(groups);
  for (std::size_t v = 0; v < group_of.size(); ++v)
    if (group_of[v] < groups) voxels[group_of[v]].push_back(static_cast<Index>(v));
  std::vector<std::uint32_t> counts;
  for (const Voxels& of_group : voxels)
    for (std::size_t s = first; s < scene.surfaces.size(); ++s)
      // mutant: report-removed
      counts.push_back(static_cast<std::uint32_t>(
          count_on(scene.surfaces[s].plane, scene.vertices, of_group, scene.viewpoint)));
  return counts;
}

}  // namespace ph::segment
