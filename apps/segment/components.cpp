// SPDX-License-Identifier: MIT
#include "components.hpp"

#include <algorithm>

namespace ph::segment {
namespace {

/// One component while it is measured.
struct Component {
  Index root = 0;     // the vertex that names it
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
std::vector<Component> measured(const SceneTree& scene, const std::vector<Index>& component_of) {
  std::vector<Component> by_root(component_of.size());
  for (std::size_t v = 0; v < component_of.size(); ++v) {
    Component& component = by_root[static_cast<std::size_t>(component_of[v])];
    Segment& s = component.segment;
    ++s.voxels;
    component.in_grid += scene.counts[v];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      s.centroid[axis] += static_cast<double>(scene.counts[v]) *
                          scene.vertices(static_cast<Index>(v), static_cast<Index>(axis));
    }
  }
  for (const std::uint32_t v : scene.vertex_of_point)
    if (v != SceneTree::kNoVertex)
      ++by_root[static_cast<std::size_t>(component_of[v])].segment.points;
  return by_root;
}

void measure_point(Segment& s, bool first, const float* p) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double x = p[axis];
    s.box.min[axis] = first ? x : std::min(s.box.min[axis], x);
    s.box.max[axis] = first ? x : std::max(s.box.max[axis], x);
  }
}

}  // namespace

SceneCut extract_components(const SceneTree& scene, const std::vector<Index>& component_of,
                            Index min_size) {
  std::vector<Component> by_root = measured(scene, component_of);
  std::vector<Component> kept;
  for (std::size_t v = 0; v < by_root.size(); ++v) {
    if (by_root[v].segment.voxels < std::max<Index>(min_size, 1)) continue;
    by_root[v].root = static_cast<Index>(v);
    kept.push_back(by_root[v]);
  }
  std::ranges::sort(kept, comes_before);

  SceneCut result;
  std::vector<std::uint32_t> label_of_root(by_root.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    Segment& s = kept[i].segment;
    s.label = static_cast<std::uint32_t>(i + 1);
    for (double& c : s.centroid) c /= static_cast<double>(kept[i].in_grid);
    label_of_root[static_cast<std::size_t>(kept[i].root)] = s.label;
    result.segments.push_back(s);
  }
  result.vertex_labels.reserve(component_of.size());
  for (const Index root : component_of)
    result.vertex_labels.push_back(label_of_root[static_cast<std::size_t>(root)]);

  result.labels.resize(scene.vertex_of_point.size());
  std::vector<bool> seen(kept.size());
  const float* next = scene.xyz.data();
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    if (scene.vertex_of_point[i] == SceneTree::kNoVertex) continue;
    const float* p = next;
    next += 3;
    const std::uint32_t label = result.vertex_labels[scene.vertex_of_point[i]];
    if (label == 0) continue;
    result.labels[i] = label;
    measure_point(result.segments[label - 1], !seen[label - 1], p);
    seen[label - 1] = true;
  }
  return result;
}

}  // namespace ph::segment
