// SPDX-License-Identifier: MIT
#include "components.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory_resource>
#include <numeric>

#include "ph/core/disjoint_sets.hpp"
#include "ph/core/error.hpp"

namespace ph::segment {
namespace {

/// One component while it is measured.
struct Component {
  Index root = 0;     // the voxel that names it
  Index in_grid = 0;  // points that its centroid is of
  Segment segment;
};

/// By decreasing number of points, then of voxels, then in grid order: independent of the order of
/// the points.
bool comes_before(const Component& a, const Component& b) {
  if (a.segment.points != b.segment.points) return a.segment.points > b.segment.points;
  if (a.segment.voxels != b.segment.voxels) return a.segment.voxels > b.segment.voxels;
  return a.root < b.root;
}

/// Centroids stay sums.
void measure_voxels(const VoxelGrid& grid, const std::vector<Index>& component_of,
                    std::vector<Component>& by_root) {
  for (std::size_t v = 0; v < component_of.size(); ++v) {
    Component& component = by_root[static_cast<std::size_t>(component_of[v])];
    Segment& s = component.segment;
    ++s.voxels;
    component.in_grid += grid.counts[v];
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
                              const VoxelGrid& grid, const std::vector<Index>& component_of,
                              Index min_size) {
  Components result;
  result.labels.resize(cloud.xyz.size() / 3);
  std::vector<Component> by_root(component_of.size());
  measure_voxels(grid, component_of, by_root);
  const auto root_of_point = [&](std::size_t k) {
    return static_cast<std::size_t>(component_of[grid.voxel_of[k]]);
  };
  for (std::size_t k = 0; k < points.size(); ++k) ++by_root[root_of_point(k)].segment.points;

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
    for (double& c : s.centroid) c /= static_cast<double>(kept[i].in_grid);
    label_of_root[static_cast<std::size_t>(kept[i].root)] = s.label;
    result.segments.push_back(s);
  }
  result.label_of_voxel.reserve(component_of.size());
  for (const Index root : component_of)
    result.label_of_voxel.push_back(label_of_root[static_cast<std::size_t>(root)]);
  std::vector<bool> seen(kept.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::uint32_t label = result.label_of_voxel[grid.voxel_of[k]];
    if (label == 0) continue;
    const auto i = static_cast<std::size_t>(points[k]);
    result.labels[i] = label;
    measure_point(result.segments[label - 1], !seen[label - 1], &cloud.xyz[3 * i]);
    seen[label - 1] = true;
  }
  return result;
}

void find_neighbours(const MergeTree& tree, Components& components) {
  const std::vector<std::uint32_t>& label = components.label_of_voxel;
  std::vector<double> birth(components.segments.size() + 1, kInfinity);
  for (std::size_t v = 0; v < label.size(); ++v)
    birth[label[v]] = std::min(birth[label[v]], tree.births[v]);
  const auto meet = [&](std::uint32_t a, std::uint32_t b, double value) {
    Segment& s = components.segments[a - 1];
    if (s.neighbour != 0) return;
    s.neighbour = b;
    s.meets_at = value;
    s.persistence = value - birth[a];
  };
  for (const Merge& m : tree.merges) {  // by value: the first one counts
    const std::uint32_t a = label[static_cast<std::size_t>(m.u)];
    const std::uint32_t b = label[static_cast<std::size_t>(m.v)];
    if (a == b || a == 0 || b == 0) continue;
    meet(a, b, m.value);
    meet(b, a, m.value);
  }
}

std::optional<Meeting> first_meeting(const Segmentation& s, std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t label : {a, b})
    if (label == 0 || label > s.segments.size())
      throw Error(ErrorKind::usage, fmt::format("segment {}: there are the segments 1 to {}", label,
                                                s.segments.size()));
  if (a == b) throw Error(ErrorKind::usage, fmt::format("segment {}: found it twice", a));
  // The parts of a segment are one from the beginning.
  DisjointSets sets(s.vertex_labels.size(), std::pmr::get_default_resource());
  const auto join = [&](std::uint32_t u, std::uint32_t v) {
    const std::uint32_t x = sets.find(u), y = sets.find(v);
    if (x != y) sets.link(x, y);
  };
  const auto first_of = [&](std::uint32_t label) {
    return static_cast<std::uint32_t>(std::ranges::find(s.vertex_labels, label) -
                                      s.vertex_labels.begin());
  };
  const std::uint32_t first_a = first_of(a), first_b = first_of(b);
  for (std::uint32_t v = 0; v < s.vertex_labels.size(); ++v) {
    if (s.vertex_labels[v] == a) join(v, first_a);
    if (s.vertex_labels[v] == b) join(v, first_b);
  }
  for (const Merge& m : s.tree.merges) {
    join(static_cast<std::uint32_t>(m.u), static_cast<std::uint32_t>(m.v));
    if (sets.find(first_a) != sets.find(first_b)) continue;
    Meeting meeting{.value = m.value};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Index>(k);
      meeting.at[k] = (s.vertices(m.u, axis) + s.vertices(m.v, axis)) / 2;
    }
    return meeting;
  }
  return std::nullopt;
}

}  // namespace ph::segment
