// SPDX-License-Identifier: MIT
#include "surfaces/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ph/eigen.hpp"
#include "surfaces/planar.hpp"

namespace ph::segment {
namespace {

constexpr double kLeastShare = 0.85;  // of a surface on its plane

using Voxels = std::vector<Index>;

/// By the vertex that names a component; those that are too small are empty.
std::vector<Voxels> large_components(const std::vector<Index>& component_of, Index min_size) {
  std::vector<Voxels> components(component_of.size());
  for (std::size_t v = 0; v < component_of.size(); ++v)
    components[static_cast<std::size_t>(component_of[v])].push_back(static_cast<Index>(v));
  for (Voxels& voxels : components)
    if (std::cmp_less(voxels.size(), min_size)) voxels.clear();
  return components;
}

/// Whether all that is seen lies on the viewpoint's side of a plane.
bool bounds_the_view(const Plane& plane, const CloudView& cloud) {
  constexpr double margin = 0.02;       // metres at one metre: some times the noise
  constexpr double most_behind = 0.01;  // of all points: reflections, flying pixels
  const auto& [vx, vy, vz] = cloud.viewpoint;
  std::size_t all = 0, behind = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float* p = cloud.point(i);
    const double x = p[0] - vx, y = p[1] - vy, z = p[2] - vz;
    const double square = x * x + y * y + z * z;
    const double limit = margin * std::max(1.0, square);
    // Points that are not finite fail both comparisons.
    all += square < kInfinity ? 1U : 0U;
    behind += plane.signed_distance(p[0], p[1], p[2]) < -limit ? 1U : 0U;
  }
  return static_cast<double>(behind) <= most_behind * static_cast<double>(all);
}

/// How much of a plane some voxels cover, square metres.
double covered_area(const Plane& plane, const Points& centroids, const Voxels& voxels,
                    double voxel) {
  const double side = 2 * voxel;  // no gaps
  const Eigen::Vector3d normal(plane.normal.data());
  const Eigen::Vector3d across = normal.unitOrthogonal() / side, along = normal.cross(across);
  std::vector<std::pair<double, double>> squares;
  for (const Index v : voxels) {
    const Eigen::Vector3d p = as_matrix(centroids).row(v).transpose();
    squares.emplace_back(std::floor(across.dot(p)), std::floor(along.dot(p)));
  }
  std::ranges::sort(squares);
  const auto same = std::ranges::unique(squares);
  squares.erase(same.begin(), same.end());
  return static_cast<double>(squares.size()) * side * side;
}

}  // namespace

std::vector<SceneSurface> find_bounds(const CloudView& cloud, const Plane& support,
                                      const SceneTree& scene,
                                      const std::vector<Index>& component_of, Index min_size) {
  constexpr double most_of_a_wall = 0.5, least_of_a_board = 0.98;  // cosines with the support
  constexpr double least_area = 0.2;  // square metres of a board: twice a large board game
  std::vector<SceneSurface> found;
  for (const Voxels& voxels : large_components(component_of, min_size)) {
    if (voxels.empty()) continue;
    const auto plane = plane_through(scene.vertices, scene.normals, voxels, cloud.viewpoint);
    if (!plane || plane->share < kLeastShare) continue;
    double cosine = 0;
    for (std::size_t k = 0; k < 3; ++k) cosine += plane->normal[k] * support.normal[k];
    if (std::abs(cosine) < most_of_a_wall && bounds_the_view(*plane, cloud))
      found.push_back({Role::wall, *plane});
    else if (cosine > least_of_a_board &&
             covered_area(*plane, scene.vertices, voxels, scene.voxel) >= least_area)
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
  const std::vector<Voxels> components = large_components(component_of, min_size);
  for (std::size_t c = 0; c < components.size(); ++c) {
    for (std::size_t s = first; s < scene.surfaces.size() && !components[c].empty(); ++s) {
      if (share_on(scene.surfaces[s].plane, scene.vertices, components[c], scene.viewpoint) <
          kLeastShare)
        continue;
      surfaces[c] = static_cast<std::uint8_t>(s + 1);
      break;
    }
  }
  return surfaces;
}

}  // namespace ph::segment
