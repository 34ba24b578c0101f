// SPDX-License-Identifier: MIT
#include "libsegment/src/supports/stages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "libsegment/src/plane/plane.hpp"

namespace ph::segment {
namespace {

// Shares of the voxels of a segment: where its lower and its upper end are. The voxels beyond them
// may be wrong.
constexpr double kLowerEnd = 0.02, kUpperEnd = 0.98;
constexpr Index kFewest = 10;  // the number of points, or of pairs of voxels, that show a contact

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

/// A contact of one segment with another.
struct Contact {
  Index pairs = 0;
  double heights = 0;  // the sum of the heights of the pairs
};

/// For each segment, the height below which a share of its voxels lies.
std::vector<double> ends_of(const SceneCut& cut, const std::vector<double>& heights, double share) {
  std::vector<std::vector<double>> of(cut.segments.size() + 1);
  for (std::size_t v = 0; v < heights.size(); ++v) of[cut.vertex_labels[v]].push_back(heights[v]);
  std::vector<double> ends(of.size());
  for (std::size_t label = 1; label < of.size(); ++label) {
    const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(of[label].size()));
    std::ranges::nth_element(of[label], of[label].begin() + rank);
    ends[label] = of[label][static_cast<std::size_t>(rank)];
  }
  return ends;
}

/// The height of a removed support above the plane from which heights are measured, near a segment.
double height_of(const Plane& support, const Plane& from, const Segment& segment) {
  const auto& [x, y, z] = segment.centroid;
  return from.signed_distance(x, y, z) - support.signed_distance(x, y, z);
}

/// Sets what the segments stand on that reach down to removed supports. Of several supports that a
/// segment reaches, it stands on the one that is nearest to its lower end: the others only cross
/// its sides.
void find_removed_supports(const SceneTree& scene, const std::vector<double>& ends, SceneCut& cut) {
  std::vector<double> nearest(cut.segments.size() + 1, kInfinity);
  for (Index s = 0; s < scene.removed; ++s) {
    const SceneSurface& surface = scene.surfaces[static_cast<std::size_t>(s)];
    if (!is_support(surface.role)) continue;
    const std::vector<Index> count = points_at(scene, cut, surface.plane);
    for (Segment& segment : cut.segments) {
      if (count[segment.label] < kFewest) continue;
      const double height = height_of(surface.plane, scene.surfaces.front().plane, segment);
      const double away = std::abs(height - ends[segment.label]);
      if (away >= nearest[segment.label]) continue;  // mutant: standing-nearest
      nearest[segment.label] = away;
      segment.on = {static_cast<std::uint32_t>(s + 1), 0};
    }
  }
}

/// True if a segment that ends below a support is under it, and ends at its lower side or where the
/// support begins to hide it. @param below how far the end is from the upper side of the support.
bool reaches(const Segment& segment, const SceneSurface& support, const Vec3& viewpoint,
             double below) {
  const OrientedBox& box = support.oriented_box;
  // Coordinates along the axes of the box: the support is at height zero.
  const auto within = [&](const Vec3& p) -> Vec3 {
    const double x = p[0] - box.centre[0], y = p[1] - box.centre[1], z = p[2] - box.centre[2];
    Vec3 result{};
    for (std::size_t k = 0; k < 2; ++k)
      result[k] = box.axes[k][0] * x + box.axes[k][1] * y + box.axes[k][2] * z;
    result[2] = support.plane.signed_distance(p[0], p[1], p[2]);
    return result;
  };
  const auto is_over_box = [&](double x, double y) {
    const double beyond = segment.oriented_box.size[0];  // the border may be hidden
    return std::abs(x) <= box.size[0] / 2 + beyond && std::abs(y) <= box.size[1] / 2 + beyond;
  };
  const auto [x, y, _] = within(segment.centroid);
  if (!is_over_box(x, y)) return false;
  if (below <= kThickestBoard) return true;
  // The sensor is above the support. The ray to the end passes the lower side of the support here.
  const Vec3 eye = within(viewpoint);
  const double share = (below - kThickestBoard) / (below + eye[2]);
  // mutant: role-hidden
  return is_over_box(x + share * (eye[0] - x), y + share * (eye[1] - y));
}

/// True if a segment is below a leg, and the middle of it is not beside the leg.
bool is_under(const Segment& segment, const Segment& leg, const Plane& support) {
  const auto [nx, ny, nz] = support.normal;
  const double x = segment.centroid[0] - leg.centroid[0], y = segment.centroid[1] - leg.centroid[1];
  const double z = segment.centroid[2] - leg.centroid[2];
  const double up = nx * x + ny * y + nz * z;
  const double beside = std::hypot(x - up * nx, y - up * ny, z - up * nz);
  return up < 0 && beside <= leg.oriented_box.size[0];
}

/// Sets the role of the legs of tables: narrow, slender segments under a support, where there is a
/// floor. They end at its lower side, or where the support begins to hide them. The noise of depth
/// may tear a leg into pieces, and so narrow segments under such a segment are legs as well.
void find_legs(const SceneTree& scene, const std::vector<double>& tops, SceneCut& cut) {
  constexpr double least_slenderness = 2, most_width = 0.15;
  if (std::ranges::find(scene.surfaces, Role::floor, &SceneSurface::role) == scene.surfaces.end())
    return;
  for (const SceneSurface& surface : scene.surfaces) {
    if (surface.role != Role::support) continue;
    for (Segment& segment : cut.segments) {
      const double width = segment.oriented_box.size[1], height = segment.oriented_box.size[2];
      const double below =
          height_of(surface.plane, scene.surfaces.front().plane, segment) - tops[segment.label];
      // mutant: role-leg
      if (below >= 0 && width <= most_width && height >= least_slenderness * width &&
          reaches(segment, surface, scene.viewpoint, below - 2 * scene.voxel))
        segment.role = Role::support;
    }
  }
  std::vector<Segment> legs;
  std::ranges::copy_if(cut.segments, std::back_inserter(legs),
                       [](const Segment& segment) { return segment.role == Role::support; });
  for (Segment& segment : cut.segments)
    // mutant: role-piece
    if (segment.role == Role::object && segment.oriented_box.size[1] <= most_width &&
        std::ranges::any_of(legs, [&](const Segment& leg) {
          return is_under(segment, leg, scene.surfaces.front().plane);
        }))
      segment.role = Role::support;
}

}  // namespace

void find_what_it_stands_on(const SceneTree& scene, std::span<const VoxelPair> pairs,
                            SceneCut& cut) {
  if (scene.surfaces.empty()) return;
  const Plane& support = scene.surfaces.front().plane;
  std::vector<double> heights;
  for (Index v = 0; v < scene.vertices.rows(); ++v) {
    const auto p = scene.vertices.row(v);
    heights.push_back(support.signed_distance(p[0], p[1], p[2]));
  }
  const std::vector<double> ends = ends_of(cut, heights, kLowerEnd);
  find_removed_supports(scene, ends, cut);
  find_legs(scene, ends_of(cut, heights, kUpperEnd), cut);
  std::map<std::pair<std::uint32_t, std::uint32_t>, Contact> contacts;
  for (const VoxelPair& pair : pairs) {
    const std::uint32_t a = cut.vertex_labels[pair.u], b = cut.vertex_labels[pair.v];
    if (a == b || a == 0 || b == 0) continue;
    Contact& contact = contacts[std::minmax(a, b)];
    ++contact.pairs;
    contact.heights += (heights[pair.u] + heights[pair.v]) / 2;
  }
  constexpr double voxels_up = 3;
  const double reach = voxels_up * scene.voxel;
  std::vector<Index> most(cut.segments.size() + 1);
  const auto stands_on = [&](std::uint32_t upper, std::uint32_t lower, const Contact& contact) {
    Segment& segment = cut.segments[upper - 1];
    if (segment.on.surface != 0 || contact.pairs < kFewest || contact.pairs <= most[upper]) return;
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
