// SPDX-License-Identifier: MIT
// W. J. Beksi and N. Papanikolopoulos, 3D Point Cloud Segmentation Using Topological Persistence,
// ICRA 2016. The numbers of sections and algorithms here and in methods.cpp refer to this paper.
#include <algorithm>
#include <iterator>
#include <utility>

#include "libsegment/src/methods.hpp"
#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/plane/projection_centre.hpp"
#include "libsegment/src/plane/sample.hpp"
#include "libsegment/src/plane/stages.hpp"
#include "libsegment/src/scene/options.hpp"
#include "libsegment/src/supports/surfaces.hpp"
#include "libsegment/src/tree/cross_check.hpp"
#include "libsegment/src/vessels/stages.hpp"
#include "ph/detail/segment/bounds.hpp"
#include "ph/detail/segment/tree_barcode.hpp"
#include "ph/error.hpp"
#include "ph/segment.hpp"

namespace ph::segment {
namespace {

/// The most memory that all stages together need for the points. The data of each point are its
/// number in five lists of points; its voxel; its number, its vertex and its coordinates
/// in the tree; a copy of the coordinates, sorted by segment; its label; and its surfaces.
std::size_t bytes_for_points(const CloudView& cloud) {
  constexpr std::size_t bytes_per_point = 6 * 8 + 4 + 4 + 12 + 12 + 4 + 2;
  return cloud.size() * bytes_per_point;
}

/// The most memory that the voxels need, without the pairs and the graph, whose memory is counted
/// separately. Each voxel has a place, a normal and a number of points, both here and in the tree.
/// The merge tree and the barcode also need memory.
std::size_t bytes_for_voxels(const VoxelGrid& grid) {
  constexpr std::size_t bytes_per_voxel = 2 * 80 + 80 + 160;
  return grid.cells.size() * bytes_per_voxel;
}

Index count(const std::vector<Index>& points) { return static_cast<Index>(points.size()); }

/// The points in range that are above the supporting plane. The plane is also stored in the result.
Scene clear_scene(const CloudView& cloud, const SegmentOptions& options, StageClock& clock,
                  Segmentation& result) {
  Scene scene;
  scene.cloud = cloud;
  scene.margin = {options.plane_margin()};

  // Section VI of the paper: "we remove outlying points (background clutter) that are beyond range"
  std::vector<Index> in_range = range_filter(cloud, options.max_range, options.crop);
  clock.finish("range filter", count(in_range));

  if (!options.plane) {
    result.plane_note = "no plane: its removal is switched off";
    scene.points.beyond = std::move(in_range);
    return scene;
  }
  // Section VI of the paper: "we find all points that correspond to a planar model and remove them"
  const bool is_paper = options.method == Method::paper;
  if (!is_paper) scene.margin.noise = options.noise_floor();
  Sample sample;
  SupportSearch search;
  if (is_paper) {
    search.support = find_plane(cloud, in_range, scene.margin, options.plane_guess);
  } else if (in_range.size() < 3) {
    search.support.note = kTooFewPoints;
  } else {
    sample = draw_sample(cloud, in_range, scene.margin);
    search = find_support(cloud, in_range, scene.margin, sample, options.plane_guess);
  }
  PlaneSearch& support = search.support;
  if (!is_paper && options.plane_noise > 0)
    scene.margin.noise = std::max(scene.margin.noise, kDeviations * support.noise);
  scene.noise = support.noise_along;
  scene.range = support.range;
  result.tree.plane = scene.plane = support.plane;
  result.plane_note = std::move(support.note);
  if (scene.plane) {
    result.plane_sight = sight_past(cloud, in_range, *scene.plane, scene.margin);
    if (options.method == Method::surface) {
      clear_surfaces(in_range, search.others, sample, result.plane_sight, options.most_supports,
                     scene, result.tree);
    } else {
      scene.points = remove_plane(cloud, in_range, *scene.plane, scene.margin);
      add_surface(Role::support, *scene.plane, cloud, scene.points.on, result.tree);
    }
    result.tree.removed = std::ssize(result.tree.surfaces);
    scene.in_range = std::move(in_range);
  } else
    scene.points.beyond = std::move(in_range);
  clock.finish("plane", count(scene.points.beyond));
  return scene;
}

/// The points with their voxels, in the order of the cloud.
void keep_points(const CloudView& cloud, const VoxelFiltration& filtration, SceneTree& scene) {
  const std::vector<Index>& points = filtration.points;
  const std::vector<std::uint32_t>& voxel_of = filtration.grid.voxel_of;
  // The points beyond the plane come first, in ascending order. The points that were won back
  // follow.
  const auto beyond =
      static_cast<std::size_t>(std::ranges::is_sorted_until(points) - points.begin());
  std::vector<std::pair<Index, std::uint32_t>> won_back;
  for (std::size_t k = beyond; k < points.size(); ++k)
    won_back.emplace_back(points[k], voxel_of[k]);
  std::ranges::sort(won_back);
  scene.points.reserve(points.size());
  scene.vertex_of_point.reserve(points.size());
  for (std::size_t next = 0, next_back = 0; scene.points.size() < points.size();) {
    const bool is_back =
        next == beyond || (next_back < won_back.size() && won_back[next_back].first < points[next]);
    const auto& [point, voxel] =
        is_back ? won_back[next_back++] : std::pair(points[next], voxel_of[next]);
    next += is_back ? 0 : 1;
    scene.points.push_back(point);
    scene.vertex_of_point.push_back(voxel);
  }
  for (const Index i : scene.points) scene.removed_with[static_cast<std::size_t>(i)] = 0;
  scene.xyz.resize(3 * points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    std::copy_n(cloud.point(static_cast<std::size_t>(scene.points[k])), 3, &scene.xyz[3 * k]);
}

/// Stores the data that a cut needs in addition to the tree and the points. `scene.plane` is set
/// already.
void keep_scene(const CloudView& cloud, const VoxelFiltration& filtration,
                const SegmentOptions& options, SceneTree& scene) {
  scene.method = options.method;
  scene.voxel = filtration.voxel;
  if (options.method == Method::paper) {
    scene.distance = options.distance;
    scene.steps = options.steps;
  }
  scene.viewpoint = cloud.viewpoint;
  scene.width = cloud.columns();
  scene.height = cloud.rows();
  scene.first_cut = options.cut();
  scene.cells = filtration.grid.cells;
  scene.vertices = filtration.grid.centroids;
  scene.normals = filtration.surface.normals;
  scene.counts = filtration.grid.counts;
  scene.edges = static_cast<Index>(filtration.graph.edge_count());
}

}  // namespace

Segmentation segment(const CloudView& input, const SegmentOptions& options,
                     const RunContext& context) {
  validate(input, options);
  CloudView cloud = input;
  cloud.viewpoint = options.viewpoint.value_or(input.viewpoint);
  const MemoryClaim of_points(context.memory, bytes_for_points(cloud));
  Segmentation result;
  result.tree.removed_with.resize(cloud.size());
  StageClock clock(context, result.stages);
  result.rays_meet_at = centre_elsewhere(cloud);  // mutant: viewpoint-rays
  if (result.rays_meet_at && !options.viewpoint) cloud.viewpoint = *result.rays_meet_at;
  const Scene scene = clear_scene(cloud, options, clock, result);
  VoxelFiltration filtration = options.method == Method::paper
                                   ? rips_filtration(scene, options, context, clock)
                                   : surface_filtration(scene, options, context, clock);

  result.tree.noise = filtration.noise;
  const MemoryClaim of_voxels(context.memory, bytes_for_voxels(filtration.grid));

  // Alg. 2 of the paper: the death times of the zero-dimensional cycles, by the disjoint sets of
  // V.C
  result.tree.merge_tree = merge_tree(filtration.graph, context);
  result.barcode = barcode_of(result.tree.merge_tree);
  clock.finish("persistence", filtration.graph.size());

  keep_scene(cloud, filtration, options, result.tree);
  const Components components = components_of(result.tree, filtration.grid, filtration.surface,
                                              result.tree.first_cut, context);
  if (options.method == Method::surface && scene.plane)
    assign_points_in_openings(cloud, scene.in_range, *scene.plane, filtration.voxel, components.of,
                              result.tree.first_cut.min_size, filtration.points, filtration.grid);
  keep_points(cloud, filtration, result.tree);
  if (options.method == Method::surface && scene.plane)
    std::ranges::copy(find_bounds(cloud, *scene.plane, result.tree, components.of,
                                  result.tree.first_cut.min_size),
                      std::back_inserter(result.tree.surfaces));
  result.cut =
      cut_into(result.tree, components, filtration.surface, result.tree.first_cut, context);
  Index in_segments = 0;
  for (const Segment& s : result.cut.segments) in_segments += s.voxels;
  clock.finish("components", in_segments);

  // Section V.B of the paper defines persistence by the boundary matrix. The fast path must agree
  // with it.
  if (options.check) {
    result.difference = cross_check(filtration.graph, result.barcode, context);
    result.checked = true;
    clock.finish("check", in_segments);
  }
  return result;
}

Segmentation segment(const Cloud& cloud, const SegmentOptions& options, const RunContext& context) {
  const std::vector<float> xyz = cloud.xyz();
  const MemoryClaim copy(context.memory, xyz.size() * sizeof(float));
  const auto& [x, y, z, qw, qx, qy, qz] = cloud.viewpoint;
  return segment(CloudView{xyz, {x, y, z}, cloud.width, cloud.height}, options, context);
}

}  // namespace ph::segment
