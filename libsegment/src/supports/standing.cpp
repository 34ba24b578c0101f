// SPDX-License-Identifier: MIT
#include "libsegment/src/supports/stages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace ph::segment {
namespace {

/// The number of points of each segment that are as low as a support. The distance of these points
/// from the support is at most two voxels plus a margin. The margin grows with the square of the
/// range.
std::vector<Index> points_at(const SceneTree& scene, const SceneCut& cut, const Plane& support) {
  // The margin is in metres, at a range of one metre.
  constexpr double margin = 0.005, voxels = 2;
  const auto& [vx, vy, vz] = scene.viewpoint;
  std::vector<Index> count(cut.segments.size() + 1);
  for (std::size_t k = 0; k < scene.points.size(); ++k) {
    const float* p = &scene.xyz[3 * k];
    const double x = p[0] - vx, y = p[1] - vy, z = p[2] - vz;
    const double low = margin * std::max(1.0, x * x + y * y + z * z) + voxels * scene.voxel;
    const double height = support.signed_distance(p[0], p[1], p[2]);
    count[cut.vertex_labels[scene.vertex_of_point[k]]] += std::abs(height) < low ? 1 : 0;
  }
  return count;
}

/// For each vertex, the number of the support on which it is, if that support was found among the
/// components (not removed). Otherwise 0.
std::vector<std::uint8_t> boards_of(const SceneTree& scene, const SceneCut& cut) {
  std::vector<std::uint8_t> boards(scene.cells.size());
  for (std::size_t k = 0; k < scene.points.size(); ++k) {
    const std::uint8_t number = cut.surface_labels[static_cast<std::size_t>(scene.points[k])];
    if (number > scene.removed && scene.surfaces[number - 1U].role == Role::support)
      boards[scene.vertex_of_point[k]] = number;
  }
  return boards;
}

/// A contact of one segment with another.
struct Contact {
  Index pairs = 0;
  double heights = 0;  // the sum of the heights of the pairs
};

/// The height of the lower end of each segment. One voxel in fifty is ignored, because it may be
/// wrong.
std::vector<double> lower_ends(const SceneCut& cut, const std::vector<double>& heights) {
  constexpr std::size_t outliers = 50;
  std::vector<std::vector<double>> of(cut.segments.size() + 1);
  for (std::size_t v = 0; v < heights.size(); ++v) of[cut.vertex_labels[v]].push_back(heights[v]);
  std::vector<double> ends(of.size());
  for (std::size_t label = 1; label < of.size(); ++label) {
    const auto low = of[label].begin() + static_cast<std::ptrdiff_t>(of[label].size() / outliers);
    std::ranges::nth_element(of[label], low);
    ends[label] = *low;
  }
  return ends;
}

}  // namespace

void find_what_it_stands_on(const SceneTree& scene, std::span<const VoxelPair> pairs,
                            SceneCut& cut) {
  if (scene.surfaces.empty()) return;
  constexpr Index fewest = 10;  // the number of points, or of pairs of voxels
  for (Index s = scene.removed; s-- > 0;) {
    const SceneSurface& surface = scene.surfaces[static_cast<std::size_t>(s)];
    if (surface.role != Role::support) continue;
    const auto number = static_cast<std::uint32_t>(s + 1);
    const std::vector<Index> count = points_at(scene, cut, surface.plane);
    for (Segment& segment : cut.segments)
      if (count[segment.label] >= fewest) segment.on = {number, 0};
  }
  const Plane& support = scene.surfaces.front().plane;
  std::vector<double> heights;
  for (Index v = 0; v < scene.vertices.rows(); ++v) {
    const auto p = scene.vertices.row(v);
    heights.push_back(support.signed_distance(p[0], p[1], p[2]));
  }
  const std::vector<std::uint8_t> boards = boards_of(scene, cut);
  std::map<std::pair<std::uint32_t, std::uint8_t>, Index> at_boards;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Contact> contacts;
  for (const VoxelPair& pair : pairs) {
    const std::uint32_t a = cut.vertex_labels[pair.u], b = cut.vertex_labels[pair.v];
    if (a == b) continue;
    if (a == 0 || b == 0) {
      const std::uint8_t board = a == 0 ? boards[pair.u] : boards[pair.v];
      if (board != 0) ++at_boards[{a + b, board}];
      continue;
    }
    Contact& contact = contacts[std::minmax(a, b)];
    ++contact.pairs;
    contact.heights += (heights[pair.u] + heights[pair.v]) / 2;
  }
  for (const auto& [both, count] : at_boards)
    if (count >= fewest) cut.segments[both.first - 1].on = {both.second, 0};
  const double reach = 3 * scene.voxel;
  const std::vector<double> ends = lower_ends(cut, heights);
  std::vector<Index> most(cut.segments.size() + 1);
  const auto stands_on = [&](std::uint32_t upper, std::uint32_t lower, const Contact& contact) {
    Segment& segment = cut.segments[upper - 1];
    if (segment.on.surface != 0 || contact.pairs < fewest || contact.pairs <= most[upper]) return;
    const double height = contact.heights / static_cast<double>(contact.pairs);
    if (height > ends[upper] + reach || height < ends[lower] + reach) return;
    most[upper] = contact.pairs;
    segment.on.segment = lower;
  };
  for (const auto& [both, contact] : contacts) {
    stands_on(both.first, both.second, contact);
    stands_on(both.second, both.first, contact);
  }
}

}  // namespace ph::segment
