// SPDX-License-Identifier: MIT
#include "components.hpp"

#include <algorithm>
#include <numeric>

namespace ph::segment {
namespace {

/// One component while it is measured.
struct Component {
  Index root = 0;  // the vertex that gave birth to it: the first of its voxels in grid order
  Segment segment;
};

/// By decreasing number of points, then of voxels, then in grid order: independent of the order of
/// the points.
bool comes_before(const Component& a, const Component& b) {
  if (a.segment.points != b.segment.points) return a.segment.points > b.segment.points;
  if (a.segment.voxels != b.segment.voxels) return a.segment.voxels > b.segment.voxels;
  return a.root < b.root;
}

void measure_voxels(const VoxelGrid& grid, const std::vector<Index>& root_of,
                    std::vector<Component>& by_root) {
  for (std::size_t v = 0; v < root_of.size(); ++v) {
    Segment& s = by_root[static_cast<std::size_t>(root_of[v])].segment;
    ++s.voxels;
    s.points += grid.counts[v];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      s.centroid[axis] += static_cast<double>(grid.counts[v]) *
                          grid.centroids(static_cast<Index>(v), static_cast<Index>(axis));
    }
  }
}

void measure_point(Segment& s, bool first, const float* p) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double x = p[axis];
    s.box.min[axis] = first ? x : std::min(s.box.min[axis], x);
    s.box.max[axis] = first ? x : std::max(s.box.max[axis], x);
  }
}

}  // namespace

Components extract_components(const CloudView& cloud, const std::vector<Index>& points,
                              const VoxelGrid& grid, const MergeTree& tree, Index min_size) {
  Components result;
  result.labels.resize(cloud.xyz.size() / 3);
  // The edges of the complex are those of the whole filtration: at its end every merge is done.
  const std::vector<Index> root_of = tree.components(kInfinity);
  std::vector<Component> by_root(root_of.size());
  measure_voxels(grid, root_of, by_root);

  std::vector<Component> kept;
  for (std::size_t v = 0; v < by_root.size(); ++v) {
    if (by_root[v].segment.voxels < std::max<Index>(min_size, 1)) continue;
    by_root[v].root = static_cast<Index>(v);
    kept.push_back(by_root[v]);
  }
  std::ranges::sort(kept, comes_before);

  std::vector<std::uint32_t> label_of_root(by_root.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    Segment& s = kept[i].segment;
    s.label = static_cast<std::uint32_t>(i + 1);
    for (double& c : s.centroid) c /= static_cast<double>(s.points);
    label_of_root[static_cast<std::size_t>(kept[i].root)] = s.label;
    result.segments.push_back(s);
  }
  std::vector<bool> seen(kept.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto root = static_cast<std::size_t>(root_of[grid.voxel_of[k]]);
    const std::uint32_t label = label_of_root[root];
    if (label == 0) continue;
    const auto i = static_cast<std::size_t>(points[k]);
    result.labels[i] = label;
    measure_point(result.segments[label - 1], !seen[label - 1], &cloud.xyz[3 * i]);
    seen[label - 1] = true;
  }
  return result;
}

}  // namespace ph::segment
