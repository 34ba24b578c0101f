// SPDX-License-Identifier: MIT
#include "methods.hpp"

#include <cmath>
#include <utility>

#include "concavity.hpp"
#include "foot.hpp"
#include "rips_graph.hpp"
#include "voxel_pairs.hpp"

namespace ph::segment {

void StageClock::finish(std::string_view name, Index points) {
  const auto now = std::chrono::steady_clock::now();
  stages_.push_back({name, points, std::chrono::duration<double>(now - start_).count()});
  if (context_.on_progress) context_.on_progress({name, stages_.size(), 0});
  context_.poll();
  start_ = std::chrono::steady_clock::now();
}

Filtered filter_by_surface(const Scene& scene, const SegmentOptions& options,
                           const RunContext& context, StageClock& clock) {
  // In voxels: far enough to see how the surface bends, near enough not to see over a thin object.
  constexpr double neighbourhood = 3, of_normals = 2.4, square_of_foot = 0.6;
  constexpr double adjacent = 1.79;  // corners touch; sqrt(3) and a little

  const double voxel = options.voxel_size();
  std::vector<Index> points = scene.points;
  VoxelGrid grid = voxel_grid(scene.cloud, points, voxel);
  if (scene.plane) {
    adopt_feet(scene.cloud, scene.in_range, *scene.plane, scene.margin, square_of_foot * voxel,
               points, grid);
  }
  const Index voxels = grid.centroids.rows();
  clock.finish("voxel grid", voxels);

  std::vector<VoxelPair> pairs = close_voxels(grid, voxel, neighbourhood * voxel);
  clock.finish("neighbours", voxels);
  Points normals =
      surface_normals(grid.centroids, pairs, of_normals * voxel, scene.cloud.viewpoint);
  clock.finish("normals", voxels);
  const std::vector<double> values =
      smoothed(concavity(grid.centroids, normals, pairs), pairs, adjacent * voxel);
  std::vector<WeightedEdge> edges;
  for (const VoxelPair& p : pairs)
    if (p.distance < adjacent * voxel) edges.push_back({p.v, p.u, 0.0});
  FilteredGraph graph = FilteredGraph::lower_star(values, edges, context);
  clock.finish("complex", voxels);
  return {
      std::move(grid), std::move(points), std::move(graph), {std::move(normals), std::move(pairs)}};
}

Filtered filter_by_distance(const Scene& scene, const SegmentOptions& options,
                            const RunContext& context, StageClock& clock) {
  // Assumption 1: "points in the space are approximated (downsampled) with their centroid"
  VoxelGrid grid = voxel_grid(scene.cloud, scene.points, options.voxel_size());
  clock.finish("voxel grid", grid.centroids.rows());
  // Alg. 1 (V.A) and the filtration of V.B: the 1-skeleton of the Vietoris-Rips complex
  FilteredGraph rips = rips_graph(grid.centroids, options.distance, options.steps, context);
  clock.finish("complex", rips.size());
  return {std::move(grid), scene.points, std::move(rips), {}};
}

}  // namespace ph::segment
