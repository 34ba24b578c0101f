// SPDX-License-Identifier: MIT
#include "libsegment/src/objects/stages.hpp"

#include <algorithm>
#include <span>

#include "libsegment/src/objects/oriented_box.hpp"
#include "ph/detail/core/raw_vector.hpp"
#include "ph/detail/segment/bounds.hpp"

namespace ph::segment {
namespace {

/// One component during its measurement.
struct Component {
  Index root = 0;   // the vertex that names the component
  Index first = 0;  // its first vertex in the order of the grid
  Index points = 0;
  Index voxels = 0;
  Index in_grid = 0;  // the number of points that the centroid averages
  Vec3 sum{};         // the sum of these points
};

/// Components are sorted by decreasing number of points, then by decreasing number of voxels, then
/// in the order of the grid. The result does not depend on the order of the points.
bool comes_before(const Component& a, const Component& b) {
  if (a.points != b.points) return a.points > b.points;
  if (a.voxels != b.voxels) return a.voxels > b.voxels;
  return a.first < b.first;
}

std::vector<Component> measured(const SceneTree& scene, const std::vector<Index>& component_of) {
  std::vector<Component> by_root(component_of.size());
  for (std::size_t v = 0; v < component_of.size(); ++v) {
    Component& c = by_root[static_cast<std::size_t>(component_of[v])];
    if (c.voxels++ == 0) c.first = static_cast<Index>(v);
    c.in_grid += scene.counts[v];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      c.sum[axis] += static_cast<double>(scene.counts[v]) *
                     scene.vertices(static_cast<Index>(v), static_cast<Index>(axis));
    }
  }
  for (const std::uint32_t v : scene.vertex_of_point)
    ++by_root[static_cast<std::size_t>(component_of[v])].points;
  for (std::size_t v = 0; v < by_root.size(); ++v) by_root[v].root = static_cast<Index>(v);
  return by_root;
}

/// The principal axes of the voxels of each segment.
std::vector<std::array<Vec3, 3>> axes_of(const SceneTree& scene, const SceneCut& cut) {
  std::vector<std::vector<Index>> voxels(cut.segments.size());
  for (std::size_t v = 0; v < cut.vertex_labels.size(); ++v)
    if (const std::uint32_t label = cut.vertex_labels[v])
      voxels[label - 1].push_back(static_cast<Index>(v));
  std::vector<std::array<Vec3, 3>> axes;
  for (const std::vector<Index>& of_segment : voxels) {
    Points places(static_cast<Index>(of_segment.size()), 3);
    std::vector<double> weights;
    for (const Index v : of_segment) {
      std::ranges::copy(scene.vertices.row(v),
                        places.row(static_cast<Index>(weights.size())).begin());
      weights.push_back(static_cast<double>(scene.counts[static_cast<std::size_t>(v)]));
    }
    axes.push_back(principal_axes(places, weights, scene.viewpoint));
  }
  return axes;
}

/// Measures both boxes of each segment. @param points the points, sorted by segment.
void measure_boxes(const SceneTree& scene, const Coordinates& points, SceneCut& cut) {
  std::vector<std::array<Vec3, 3>> axes;
  if (!scene.plane) axes = axes_of(scene, cut);
  std::size_t first = 0;
  for (Segment& s : cut.segments) {
    const auto size = static_cast<std::size_t>(s.points);
    const Coordinates own{points.x.subspan(first, size), points.y.subspan(first, size),
                          points.z.subspan(first, size)};
    first += size;
    s.box = box_around(own);
    s.oriented_box =
        scene.plane ? box_on_plane(own, scene.plane->normal) : box_along(own, axes[s.label - 1]);
  }
}

}  // namespace

SceneCut extract_components(const SceneTree& scene, const std::vector<Index>& component_of,
                            Index min_size) {
  std::vector<Component> kept = measured(scene, component_of);
  std::vector<std::uint32_t> label_of_root(kept.size());
  const std::vector<std::uint8_t> surfaces = surfaces_of(scene, component_of, min_size);
  std::erase_if(kept, [&](const Component& c) {
    return c.voxels < min_size || surfaces[static_cast<std::size_t>(c.root)] != 0;
  });
  std::ranges::sort(kept, comes_before);

  SceneCut result;
  std::size_t points = 0;
  std::vector<std::size_t> place;  // where the next point of each segment goes in the sorted list
  for (const Component& c : kept) {
    place.push_back(points);
    points += static_cast<std::size_t>(c.points);
    Segment s;
    s.label = static_cast<std::uint32_t>(place.size());
    s.points = c.points;
    s.voxels = c.voxels;
    for (std::size_t k = 0; k < 3; ++k) s.centroid[k] = c.sum[k] / static_cast<double>(c.in_grid);
    label_of_root[static_cast<std::size_t>(c.root)] = s.label;
    result.segments.push_back(s);
  }
  result.vertex_labels.reserve(component_of.size());
  for (const Index root : component_of)
    result.vertex_labels.push_back(label_of_root[static_cast<std::size_t>(root)]);

  result.labels.resize(scene.cloud_size());
  result.surface_labels = scene.removed_with;
  result.surface_labels.resize(scene.cloud_size());
  RawVector<float> x(points), y(points), z(points);
  for (std::size_t k = 0; k < scene.points.size(); ++k) {
    const std::uint32_t v = scene.vertex_of_point[k], label = result.vertex_labels[v];
    if (label == 0) {
      result.surface_labels[static_cast<std::size_t>(scene.points[k])] =
          surfaces[static_cast<std::size_t>(component_of[v])];
      continue;
    }
    result.labels[static_cast<std::size_t>(scene.points[k])] = label;
    const std::size_t to = place[label - 1]++;
    x[to] = scene.xyz[3 * k];
    y[to] = scene.xyz[3 * k + 1];
    z[to] = scene.xyz[3 * k + 2];
  }
  measure_boxes(scene, {x, y, z}, result);
  return result;
}

}  // namespace ph::segment
