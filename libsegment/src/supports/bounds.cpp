// SPDX-License-Identifier: MIT
#include "ph/detail/segment/bounds.hpp"

#include <algorithm>
#include <array>

#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/plane/squares.hpp"
#include "libsegment/src/scene/parts.hpp"
#include "libsegment/src/supports/planar.hpp"
#include "ph/eigen.hpp"

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

/// The area of a plane that some voxels cover, in square metres.
double covered_area(const Plane& plane, const Points& centroids, const Voxels& voxels,
                    double voxel) {
  constexpr double voxels_a_side = 2;  // the voxels leave no gaps in squares of this size
  const double side = voxels_a_side * voxel;
  const Squares paper(plane, side);
  std::vector<std::array<double, 2>> squares;
  for (const Index v : voxels) squares.push_back(paper.of(as_matrix(centroids).row(v).transpose()));
  std::ranges::sort(squares);
  const auto same = std::ranges::unique(squares);
  squares.erase(same.begin(), same.end());
  return static_cast<double>(squares.size()) * side * side;
}

}  // namespace

std::vector<SceneSurface> find_bounds(const CloudView& cloud, const Plane& support,
                                      const SceneTree& scene,
                                      const std::vector<Index>& component_of, Index min_size) {
  constexpr double least_of_a_board = 0.98;  // the cosine of the angle with the support
  std::vector<SceneSurface> found;
  for (const Voxels& voxels : voxels_of(number_parts(component_of, min_size))) {
    const auto plane = plane_through(scene.vertices, scene.normals, voxels, cloud.viewpoint);
    if (!plane || plane->share < kLeastShareOnSurface) continue;
    const double cosine = cosine_between(*plane, support);
    if (is_steep(*plane, support) && bounds_the_view(*plane, cloud))
      found.push_back({Role::wall, *plane});
    else if (cosine > least_of_a_board &&
             covered_area(*plane, scene.vertices, voxels, scene.voxel) >= kLeastTable)
      found.push_back({Role::support, *plane});
    if (found.size() == kMostSurfaces / 2) break;
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
