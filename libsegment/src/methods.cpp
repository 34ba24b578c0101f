// SPDX-License-Identifier: MIT
#include "libsegment/src/methods.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libsegment/src/plane/stages.hpp"
#include "libsegment/src/surface/concavity.hpp"
#include "libsegment/src/surface/noise.hpp"
#include "libsegment/src/surface/seeds.hpp"
#include "libsegment/src/voxels/base_points.hpp"
#include "libsegment/src/voxels/rips_graph.hpp"
#include "libsegment/src/voxels/voxel_pairs.hpp"
#include "ph/eigen.hpp"

namespace ph::segment {

void StageClock::finish(std::string_view name, Index points) {
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start_;
  const auto known = std::ranges::find(stages_, name, &Stage::name);
  Stage& stage = known == stages_.end() ? stages_.emplace_back() : *known;
  stage = {name, points, stage.seconds + took.count()};
  if (context_.on_progress) context_.on_progress({name, stages_.size(), 0});
  context_.poll();
  start_ = std::chrono::steady_clock::now();
}

namespace {

/// These lengths are in voxels. A neighbourhood is large enough to show how the surface bends, and
/// small enough not to reach across a thin object.
constexpr double kNeighbourhood = 3, kOfNormals = 2.4;
// A little more than sqrt(3), so that voxels whose corners touch are adjacent.
constexpr double kAdjacent = 1.79;

/// True if the voxels are so small that the points of a surface leave gaps between them. A voxel
/// then has fewer adjacent voxels on average than in a plane that is sampled as coarsely as the
/// grid. A thin object, such as a pen or a cable, also has few adjacent voxels. To tell these two
/// cases apart, the voxels of half the edge are counted. If there are not many more of them, most
/// voxels have only one point. Duplicate points do not change this number. Halving the edge doubles
/// the voxels of a line, quadruples the voxels of a plane, and does not change the number of single
/// points. Random points with too few adjacent voxels reach at most 1.45 times as many voxels.
bool is_too_fine(const Scene& scene, Index voxels, const VoxelPairs& pairs, double voxel) {
  constexpr double fewest = 6, of_half = 1.6;
  const auto adjacent = std::ranges::count_if(
      pairs, [&](const VoxelPair& pair) { return pair.distance < kAdjacent * voxel; });
  if (2 * static_cast<double>(adjacent) >= fewest * static_cast<double>(voxels)) return false;
  const VoxelGrid half = voxel_grid(scene.cloud, scene.points.beyond, voxel / 2);
  return static_cast<double>(half.cells.size()) < of_half * static_cast<double>(voxels);
}

// The edge of a voxel per metre of range: two pixels of a camera with 640 columns.
constexpr double kEdgePerMetre = 0.004;

/// The least edge of a voxel at the range of most points. Depth has steps that grow with the range;
/// with smaller voxels, they would tear a surface that is seen at a slant.
double edge_for_range(const Scene& scene) {
  constexpr double quantile = 0.75;
  const auto& [vx, vy, vz] = scene.cloud.viewpoint;
  std::vector<double> ranges;
  ranges.reserve(scene.points.beyond.size());
  for (const Index i : scene.points.beyond) {
    const float* p = scene.cloud.point(static_cast<std::size_t>(i));
    ranges.push_back(std::hypot(p[0] - vx, p[1] - vy, p[2] - vz));
  }
  if (ranges.empty()) return 0;
  const auto at = ranges.begin() +
                  static_cast<std::ptrdiff_t>(quantile * static_cast<double>(ranges.size() - 1));
  std::ranges::nth_element(ranges, at);
  return kEdgePerMetre * *at;
}

/// The concavity at each voxel, and the normals from which it was computed.
struct Relief {
  Points normals;
  std::vector<double> concavity;
};

Relief relief_of(const VoxelGrid& grid, const VoxelPairs& pairs, double voxel,
                 const Vec3& viewpoint) {
  Relief relief{surface_normals(grid.centroids, pairs, kOfNormals * voxel, viewpoint), {}};
  relief.concavity =
      smoothed(concavity(grid.centroids, relief.normals, pairs), pairs, kAdjacent * voxel);
  return relief;
}

double range_of(const Points& centroids, std::size_t v, const Vec3& viewpoint) {
  const auto row = centroids.row(static_cast<Index>(v));
  return std::hypot(row[0] - viewpoint[0], row[1] - viewpoint[1], row[2] - viewpoint[2]);
}

/// Increases the concavity where the surface is seen at a steep slant. The points there may not be
/// on a surface, but on a sheet of points between an object and its background.
void add_grazing(const Points& centroids, const Vec3& viewpoint, Relief& relief) {
  constexpr double largest_cosine = 0.3, weight = 0.3;
  for (std::size_t v = 0; v < relief.concavity.size(); ++v) {
    const auto place = centroids.row(static_cast<Index>(v));
    const auto normal = relief.normals.row(static_cast<Index>(v));
    double product = 0;
    for (std::size_t k = 0; k < 3; ++k) product += normal[k] * (viewpoint[k] - place[k]);
    const double cosine = product / range_of(centroids, v, viewpoint);
    if (cosine < largest_cosine) relief.concavity[v] += weight * (1 - cosine / largest_cosine);
  }
}

/// Measures the noise of the concavity. The function applies the same steps to free patches of the
/// supporting plane, where any concavity is noise. Returns an empty result if there is no plane.
ConcavityNoise noise_of(const Scene& scene, double voxel, const RunContext& context) {
  constexpr double side = 12;  // the side in voxels
  // A voxel with fewer near voxels is not used, because the surface around it is incomplete.
  constexpr int fewest_near = 16;
  if (!scene.plane) return {};
  const std::vector<Index> points = free_patches(
      scene.cloud, scene.points.on, scene.before.empty() ? scene.points.beyond : scene.before,
      *scene.plane, side * voxel);
  const VoxelGrid grid = voxel_grid(scene.cloud, points, voxel);
  const VoxelPairs pairs = near_voxels(grid, voxel, context);
  const Relief relief = relief_of(grid, pairs, voxel, scene.cloud.viewpoint);
  std::vector<int> near(grid.cells.size());
  for (const VoxelPair& pair : pairs) {
    ++near[pair.u];
    ++near[pair.v];
  }
  std::vector<double> ranges, values;
  for (std::size_t v = 0; v < near.size(); ++v) {
    if (near[v] < fewest_near) continue;
    ranges.push_back(range_of(grid.centroids, v, scene.cloud.viewpoint));
    values.push_back(relief.concavity[v]);
  }
  return {ranges, values};
}

/// Joins voxels that lie behind each other and are not adjacent, because the noise of depth tears a
/// distant surface into layers. @param pairs pairs of voxels that are near each other.
void add_edges_along_rays(const Scene& scene, const VoxelGrid& grid, const VoxelPairs& pairs,
                          double voxel, std::vector<WeightedEdge>& edges) {
  constexpr double deviations = 2;
  // The range from which the default edge of a voxel grows.
  const double least_range = SegmentOptions().voxel_size() / kEdgePerMetre;
  const double radius = kAdjacent * voxel;
  const Eigen::Vector3d eye(scene.cloud.viewpoint.data());
  const auto place = [&](std::uint32_t v) -> Eigen::Vector3d {
    return as_matrix(grid.centroids).row(v).transpose();
  };
  for (const VoxelPair& pair : pairs) {
    if (pair.distance < radius) continue;
    const Eigen::Vector3d ray = place(pair.u) - eye, step = place(pair.v) - place(pair.u);
    const double square_of_range = ray.squaredNorm();
    if (square_of_range < least_range * least_range) continue;
    const double along = std::abs(step.dot(ray)) / std::sqrt(square_of_range);
    if (along < deviations * scene.noise * square_of_range &&
        step.squaredNorm() - along * along < radius * radius)
      edges.push_back({pair.v, pair.u, pair.distance});
  }
}

}  // namespace

VoxelPairs near_voxels(const VoxelGrid& grid, double voxel, const RunContext& context) {
  return close_voxels(grid, voxel, kNeighbourhood, context);
}

double adjacent_radius(double voxel) { return kAdjacent * voxel; }

VoxelFiltration surface_filtration(const Scene& scene, const SegmentOptions& options,
                                   const RunContext& context, StageClock& clock) {
  constexpr double coarser = 1.5;
  // The edge grows to at most about five times its first length.
  constexpr int most_times = 4;
  double voxel = options.voxel_size();
  if (options.method == Method::surface && !options.voxel)
    voxel = std::max(voxel, edge_for_range(scene));
  std::vector<Index> points;
  VoxelGrid grid;
  VoxelPairs pairs(&context.memory);
  for (int times = 0;; ++times, voxel *= coarser) {
    points = scene.points.beyond;
    grid = voxel_grid(scene.cloud, points, voxel);
    if (scene.plane) {
      assign_base_points(scene.cloud, scene.points.strip, *scene.plane, scene.margin, voxel / 2,
                         points, grid);
      for (const OtherSupport& other : scene.others)
        assign_base_points(scene.cloud, other.strip, other.plane, other.margin, voxel / 2, points,
                           grid);
    }
    clock.finish("voxel grid", grid.centroids.rows());
    pairs = near_voxels(grid, voxel, context);
    clock.finish("neighbours", grid.centroids.rows());
    if (options.voxel || times == most_times ||
        !is_too_fine(scene, grid.centroids.rows(), pairs, voxel))
      break;
  }
  const Index voxels = grid.centroids.rows();
  Relief relief = relief_of(grid, pairs, voxel, scene.cloud.viewpoint);
  if (options.method == Method::surface) add_grazing(grid.centroids, scene.cloud.viewpoint, relief);
  auto& [normals, values] = relief;
  clock.finish("normals", voxels);
  ConcavityNoise noise;
  if (options.method == Method::surface) {
    noise = noise_of(scene, voxel, context);
    for (std::size_t v = 0; v < values.size(); ++v)
      values[v] /= noise.at(range_of(grid.centroids, v, scene.cloud.viewpoint));
    clock.finish("noise", voxels);
  }
  std::vector<WeightedEdge> edges;
  edges.reserve(pairs.size() / 2);
  for_each_within(pairs, kAdjacent * voxel, [&](const VoxelPair& p) {
    edges.push_back({p.v, p.u, p.distance});
  });
  if (options.method == Method::surface && scene.noise > 0)
    add_edges_along_rays(scene, grid, pairs, voxel, edges);
  if (options.method == Method::supervoxels)
    values = distance_to_seeds(grid.centroids, edges, values, options.spacing, context);
  FilteredGraph graph = FilteredGraph::lower_star(values, edges, context);
  clock.finish("complex", voxels);
  return {voxel,
          std::move(grid),
          std::move(points),
          std::move(graph),
          {std::move(normals), std::move(pairs), scene.cloud.viewpoint, scene.plane},
          noise.measured()};
}

VoxelFiltration rips_filtration(const Scene& scene, const SegmentOptions& options,
                                const RunContext& context, StageClock& clock) {
  // Assumption 1 of the paper: "points in the space are approximated (downsampled) with their
  // centroid"
  VoxelGrid grid = voxel_grid(scene.cloud, scene.points.beyond, options.voxel_size());
  clock.finish("voxel grid", grid.centroids.rows());
  // Alg. 1 (V.A) of the paper and the filtration of V.B: the 1-skeleton of the Vietoris-Rips
  // complex
  FilteredGraph rips = rips_graph(grid.centroids, options.distance, options.steps, context);
  clock.finish("complex", rips.size());
  return {options.voxel_size(), std::move(grid), scene.points.beyond, std::move(rips), {}, {}};
}

}  // namespace ph::segment
