// SPDX-License-Identifier: MIT
// W. J. Beksi and N. Papanikolopoulos, 3D Point Cloud Segmentation Using Topological Persistence,
// ICRA 2016. Section and algorithm numbers here and in methods.cpp are those of the paper.
#include <algorithm>
#include <utility>

#include "components.hpp"
#include "cross_check.hpp"
#include "methods.hpp"
#include "options.hpp"
#include "ph/core/error.hpp"
#include "ph/segment.hpp"
#include "plane.hpp"
#include "range_filter.hpp"

namespace ph::segment {
namespace {

/// What the stages before the voxel grid and the labels take for each point, at most.
std::size_t bytes_for_points(const CloudView& cloud) {
  constexpr std::size_t bytes_per_point = 32;
  return cloud.xyz.size() / 3 * bytes_per_point;
}

Index count(const std::vector<Index>& points) { return static_cast<Index>(points.size()); }

/// What is in range and stands before the supporting plane; the plane goes into the result, too.
Scene clear_scene(const CloudView& cloud, const SegmentOptions& options, StageClock& clock,
                  Segmentation& result) {
  Scene scene;
  scene.cloud = cloud;
  scene.margin = {options.plane_margin()};

  // Section VI: "we remove outlying points (background clutter) that are beyond range"
  std::vector<Index> in_range = range_filter(cloud, options.max_range, options.crop);
  clock.finish("range filter", count(in_range));

  if (!options.plane) {
    result.plane_note = "no plane: its removal is switched off";
    scene.points.beyond = std::move(in_range);
    return scene;
  }
  // Section VI: "we find all points that correspond to a planar model and remove them"
  PlaneSearch search = find_plane(cloud, in_range, scene.margin.distance);
  if (options.method == Method::surface) {
    constexpr double least = 0.005, deviations = 4;  // a structured-light sensor has 1.2 mm
    if (deviations * search.noise > scene.margin.distance)
      search = find_plane(cloud, in_range, deviations * search.noise);
    scene.margin.noise = std::max(least, deviations * search.noise);
  }
  result.plane = scene.plane = search.plane;
  result.plane_note = std::move(search.note);
  if (scene.plane)
    scene.points = remove_plane(cloud, in_range, *scene.plane, scene.margin);
  else
    scene.points.beyond = std::move(in_range);
  clock.finish("plane", count(scene.points.beyond));
  return scene;
}

/// For each voxel the component that becomes a segment, if it is large enough.
std::vector<Index> components_of(const MergeTree& tree, const SegmentOptions& options) {
  if (options.method == Method::surface)
    return tree.basins(options.min_persistence, options.min_part);
  // Section V.C: the sets joined to 0-simplices of infinite persistence. The edges of the complex
  // are those of the whole filtration: at its end every merge is done.
  return tree.components(kInfinity);
}

}  // namespace

Segmentation segment(const CloudView& input, const SegmentOptions& options,
                     const RunContext& context) {
  validate(input, options);
  const CloudView cloud{input.xyz, options.viewpoint.value_or(input.viewpoint)};
  context.memory.require(bytes_for_points(cloud));
  Segmentation result;
  StageClock clock(context, result.stages);
  const Scene scene = clear_scene(cloud, options, clock, result);
  Filtered filtered = options.method == Method::surface
                          ? filter_by_surface(scene, options, context, clock)
                          : filter_by_distance(scene, options, context, clock);
  const FilteredGraph& graph = filtered.graph;
  result.voxel = filtered.voxel;
  result.edges = static_cast<Index>(graph.edge_count());

  // Alg. 2: the death times of the zero-dimensional cycles, by the disjoint sets of V.C
  result.tree = merge_tree(graph, context);
  result.barcode = barcode_of(result.tree);
  clock.finish("persistence", graph.size());

  std::vector<Index> component_of = components_of(result.tree, options);
  if (options.method == Method::surface && options.objects) {
    component_of =
        join_parts(filtered.grid, filtered.surface, filtered.voxel, component_of, options.min_size);
  }
  Components found =
      extract_components(cloud, filtered.points, filtered.grid, component_of, options.min_size);
  find_neighbours(result.tree, found);
  result.segments = std::move(found.segments);
  result.labels = std::move(found.labels);
  result.vertex_labels = std::move(found.label_of_voxel);
  Index in_segments = 0;
  for (const Segment& s : result.segments) in_segments += s.voxels;
  clock.finish("components", in_segments);

  // Section V.B defines persistence by the boundary matrix: the fast path must agree with it.
  if (options.check) {
    result.difference = cross_check(graph, result.barcode, context);
    result.checked = true;
    clock.finish("check", in_segments);
  }
  result.vertices = std::move(filtered.grid.centroids);
  return result;
}

Segmentation segment(const Cloud& cloud, const SegmentOptions& options, const RunContext& context) {
  const std::vector<float> xyz = cloud.xyz();
  const auto& [x, y, z, qw, qx, qy, qz] = cloud.viewpoint;
  return segment(CloudView{xyz, {x, y, z}}, options, context);
}

}  // namespace ph::segment
