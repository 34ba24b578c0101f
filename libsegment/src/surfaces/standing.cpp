// SPDX-License-Identifier: MIT
#include "surfaces/standing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "objects/view.hpp"

namespace ph::segment {
namespace {

double dot(const Vec3& a, std::span<const double> b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// How many points of each segment lie at the height of a support.
std::vector<Index> points_at(const SceneTree& scene, const SceneCut& cut, const Plane& support) {
  constexpr double low = 2;  // voxels
  std::vector<Index> count(cut.segments.size() + 1);
  for (std::size_t k = 0; k < scene.points.size(); ++k) {
    const float* p = &scene.xyz[3 * k];
    const double height = support.signed_distance(p[0], p[1], p[2]);
    count[cut.vertex_labels[scene.vertex_of_point[k]]] +=
        std::abs(height) < low * scene.voxel ? 1 : 0;
  }
  return count;
}

/// By vertex: the number of the support that was found among the components and that it is on.
std::vector<std::uint8_t> boards_of(const SceneTree& scene, const SceneCut& cut) {
  std::vector<std::uint8_t> boards(scene.cells.size());
  for (std::size_t k = 0; k < scene.points.size(); ++k) {
    const std::uint8_t number = cut.surface_labels[static_cast<std::size_t>(scene.points[k])];
    if (number > scene.removed && scene.surfaces[number - 1U].role == Role::support)
      boards[scene.vertex_of_point[k]] = number;
  }
  return boards;
}

/// Where one segment touches another one.
struct Contact {
  Index pairs = 0;
  double up_of_first = 0, up_of_second = 0;  // sums of cosines of the normals with the vertical
};

/// What is seen to stand on something is an object, and so is that of which the lower end is hidden
/// by something nearer. All else is cut off by the border of what is seen, or hangs.
void set_roles(const SceneTree& scene, SceneCut& cut) {
  const auto stands = [](const Segment& s) { return s.on.surface != 0 || s.on.segment != 0; };
  for (Segment& s : cut.segments) s.role = stands(s) ? Role::object : Role::unknown;
  if (std::ranges::all_of(cut.segments, stands)) return;
  constexpr int fewest = 5;     // voxels beside what is nearer
  constexpr double nearer = 2;  // voxels
  const Plane& support = scene.surfaces.front().plane;
  const auto height = [&](std::size_t v) {
    const auto p = scene.vertices.row(static_cast<Index>(v));
    return support.signed_distance(p[0], p[1], p[2]);
  };
  const View view(scene.vertices, scene.voxel, scene.viewpoint);
  std::vector<int> hidden(cut.segments.size() + 1);
  for (std::uint32_t v = 0; v < cut.vertex_labels.size(); ++v) {
    const std::uint32_t label = cut.vertex_labels[v];
    if (label == 0 || stands(cut.segments[label - 1])) continue;
    const Vec3& middle = cut.segments[label - 1].centroid;
    if (height(v) < support.signed_distance(middle[0], middle[1], middle[2]) &&
        view.is_at_occluder(v, nearer * scene.voxel,
                            [&](std::uint32_t u) { return cut.vertex_labels[u]; }))
      ++hidden[label];
  }
  for (Segment& s : cut.segments)
    if (hidden[s.label] >= fewest) s.role = Role::object;
}

}  // namespace

void find_what_it_stands_on(const SceneTree& scene, std::span<const VoxelPair> pairs, double radius,
                            SceneCut& cut) {
  if (scene.surfaces.empty()) return;
  constexpr Index fewest = 10;  // points, or pairs of voxels
  const Vec3& up = scene.surfaces.front().plane.normal;
  for (Index s = scene.removed; s-- > 0;) {
    const auto number = static_cast<std::uint32_t>(s + 1);
    const std::vector<Index> count =
        points_at(scene, cut, scene.surfaces[static_cast<std::size_t>(s)].plane);
    for (Segment& segment : cut.segments)
      if (count[segment.label] >= fewest) segment.on = {number, 0};
  }
  const std::vector<std::uint8_t> boards = boards_of(scene, cut);
  std::map<std::pair<std::uint32_t, std::uint8_t>, Index> at_boards;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Contact> contacts;
  for (const VoxelPair& pair : pairs) {
    const std::uint32_t a = cut.vertex_labels[pair.u], b = cut.vertex_labels[pair.v];
    if (a == b || !(pair.distance < radius)) continue;
    if (a == 0 || b == 0) {
      const std::uint8_t board = a == 0 ? boards[pair.u] : boards[pair.v];
      if (board != 0) ++at_boards[{a + b, board}];
      continue;
    }
    const double up_u = dot(up, scene.normals.row(pair.u));
    const double up_v = dot(up, scene.normals.row(pair.v));
    if (!std::isfinite(up_u + up_v)) continue;
    Contact& contact = contacts[std::minmax(a, b)];
    ++contact.pairs;
    contact.up_of_first += a < b ? up_u : up_v;
    contact.up_of_second += a < b ? up_v : up_u;
  }
  for (const auto& [both, count] : at_boards)
    if (count >= fewest) cut.segments[both.first - 1].on = {both.second, 0};
  constexpr double faces_up = 0.7, more = 0.2;  // cosines
  std::vector<Index> most(cut.segments.size() + 1);
  const auto stands_on = [&](std::uint32_t upper, std::uint32_t lower, double up_of_upper,
                             double up_of_lower, Index count) {
    Segment& segment = cut.segments[upper - 1];
    if (segment.on.surface != 0 || count < fewest || count <= most[upper]) return;
    if (up_of_lower < faces_up || up_of_lower < up_of_upper + more) return;
    most[upper] = count;
    segment.on.segment = lower;
  };
  for (const auto& [both, contact] : contacts) {
    const auto n = static_cast<double>(contact.pairs);
    const double first = contact.up_of_first / n, second = contact.up_of_second / n;
    stands_on(both.first, both.second, first, second, contact.pairs);
    stands_on(both.second, both.first, second, first, contact.pairs);
  }
  set_roles(scene, cut);
}

}  // namespace ph::segment
