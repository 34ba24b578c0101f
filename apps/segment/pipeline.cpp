// SPDX-License-Identifier: MIT
// W. J. Beksi and N. Papanikolopoulos, 3D Point Cloud Segmentation Using Topological Persistence,
// ICRA 2016. Section and algorithm numbers below are those of the paper.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "components.hpp"
#include "cross_check.hpp"
#include "options.hpp"
#include "ph/core/error.hpp"
#include "ph/segment.hpp"
#include "plane.hpp"
#include "range_filter.hpp"
#include "rips_graph.hpp"
#include "voxel_grid.hpp"

namespace ph::segment {
namespace {

/// Writes the stage table and, between stages, reports progress and obeys a stop request.
class StageClock {
 public:
  StageClock(const RunContext& context, std::vector<Stage>& stages)
      : context_(context), stages_(stages) {}

  void finish(std::string_view name, Index points) {
    const auto now = std::chrono::steady_clock::now();
    stages_.push_back({name, points, std::chrono::duration<double>(now - start_).count()});
    if (context_.on_progress) context_.on_progress({name, stages_.size(), 0});
    context_.poll();
    start_ = std::chrono::steady_clock::now();
  }

 private:
  const RunContext& context_;
  std::vector<Stage>& stages_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// What the stages before the voxel grid and the labels take for each point, at most.
std::size_t bytes_for_points(const CloudView& cloud) {
  constexpr std::size_t bytes_per_point = 32;
  return cloud.xyz.size() / 3 * bytes_per_point;
}

Index count(const std::vector<Index>& points) { return static_cast<Index>(points.size()); }

}  // namespace

Segmentation segment(const CloudView& input, const SegmentOptions& options,
                     const RunContext& context) {
  validate(input, options);
  const CloudView cloud{input.xyz, options.viewpoint.value_or(input.viewpoint)};
  context.memory.require(bytes_for_points(cloud));
  Segmentation result;
  StageClock clock(context, result.stages);

  // Section VI: "we remove outlying points (background clutter) that are beyond range"
  std::vector<Index> points = range_filter(cloud, options.max_range, options.crop);
  clock.finish("range filter", count(points));

  // Section VI: "we find all points that correspond to a planar model and remove them"
  if (options.plane) {
    const PlaneSearch search = find_plane(cloud, points, options.plane_distance);
    result.plane = search.plane;
    result.plane_note = search.note;
    if (search.plane) points = remove_plane(cloud, points, *search.plane, options.plane_distance);
    clock.finish("plane", count(points));
  } else {
    result.plane_note = "no plane: its removal is switched off";
  }

  // Assumption 1: "points in the space are approximated (downsampled) with their centroid"
  VoxelGrid grid = voxel_grid(cloud, points, options.voxel);
  clock.finish("voxel grid", grid.centroids.rows());

  // Alg. 1 (V.A) and the filtration of V.B: the 1-skeleton of the Vietoris-Rips complex
  const FilteredGraph rips = rips_graph(grid.centroids, options.distance, options.steps, context);
  result.edges = static_cast<Index>(rips.edge_count());
  clock.finish("complex", rips.size());

  // Alg. 2: the death times of the zero-dimensional cycles, by the disjoint sets of V.C
  result.tree = merge_tree(rips, context);
  result.barcode = barcode_of(result.tree);
  clock.finish("persistence", rips.size());

  // Section V.C: the sets joined to 0-simplices of infinite persistence; VI: at least 32 points
  Components found = extract_components(cloud, points, grid, result.tree, options.min_size);
  result.segments = std::move(found.segments);
  result.labels = std::move(found.labels);
  Index in_segments = 0;
  for (const Segment& s : result.segments) in_segments += s.voxels;
  clock.finish("components", in_segments);

  // Section V.B defines persistence by the boundary matrix: the fast path must agree with it.
  if (options.check) {
    result.difference = cross_check(rips, result.barcode, context);
    result.checked = true;
    clock.finish("check", in_segments);
  }
  result.vertices = std::move(grid.centroids);
  return result;
}

Segmentation segment(const Cloud& cloud, const SegmentOptions& options, const RunContext& context) {
  const std::vector<float> xyz = cloud.xyz();
  const auto& [x, y, z, qw, qx, qy, qz] = cloud.viewpoint;
  return segment(CloudView{xyz, {x, y, z}}, options, context);
}

}  // namespace ph::segment
