// SPDX-License-Identifier: MIT
#include "libsegment/src/supports/containers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/scene/parts.hpp"
#include "libsegment/src/supports/planar.hpp"
#include "libsegment/src/vessels/upper_end.hpp"
#include "ph/detail/segment/bounds.hpp"
#include "ph/eigen.hpp"

namespace ph::segment {
namespace {

using Outline = std::vector<Eigen::Vector2d>;

/// An object, upright: z is the height above the support.
struct Thing {
  std::vector<Index> voxels;
  Outline plan;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double top = 0, bottom = 0;
  std::optional<Plane> plane;  ///< the plane on which nearly all of it lies
};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The convex hull of some points, counterclockwise (A. M. Andrew, Another efficient algorithm for
/// convex hulls in two dimensions, 1979).
Outline hull_of(Outline points) {
  std::ranges::sort(points, {}, [](const Eigen::Vector2d& p) { return std::pair(p.x(), p.y()); });
  Outline hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Eigen::Vector2d& p : points) {
      while (hull.size() >= first + 2 &&
             cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

bool is_inside(const Outline& hull, const Eigen::Vector2d& p) {
  for (std::size_t i = 0; i < hull.size(); ++i)
    if (cross(hull[(i + 1) % hull.size()] - hull[i], p - hull[i]) < 0) return false;
  return hull.size() > 2;
}

class Containers {
 public:
  Containers(const SceneTree& scene, const Surface& surface, const Parts& objects)
      : scene_(scene), things_(objects.count()) {
    const Eigen::Matrix3d turn = upright(scene.plane->normal);
    std::vector<std::vector<Eigen::Vector3d>> places(things_.size());
    for (std::size_t v = 0; v < objects.of.size(); ++v) {
      if (objects.of[v] == Parts::kSmall) continue;
      Thing& thing = things_[objects.of[v]];
      thing.voxels.push_back(static_cast<Index>(v));
      places[objects.of[v]].emplace_back(
          turn * as_matrix(scene.vertices).row(static_cast<Index>(v)).transpose());
    }
    for (std::size_t k = 0; k < things_.size(); ++k) measure(things_[k], places[k]);
    for (const VoxelPair& pair : surface.pairs) {
      const std::uint32_t a = objects.of[pair.u], b = objects.of[pair.v];
      if (a != b && a != Parts::kSmall && b != Parts::kSmall) ++contacts_[std::minmax(a, b)];
    }
  }

  /// The objects that are a container together, floor first. Empty if the object is no floor.
  std::vector<std::size_t> container_of(std::size_t floor) const {
    constexpr std::size_t fewest = 3;
    std::vector<std::size_t> parts{floor};
    Outline plan = things_[floor].plan;
    double top = things_[floor].top;
    for (std::size_t w = 0; w < things_.size(); ++w) {
      if (w == floor || !is_wall_of(w, floor)) continue;
      parts.push_back(w);
      plan.insert(plan.end(), things_[w].plan.begin(), things_[w].plan.end());
      top = std::max(top, things_[w].top);
    }
    const Outline hull = hull_of(std::move(plan));
    const auto is_held = [&](std::size_t k) {
      const Eigen::Vector3d& middle = things_[k].middle;
      return std::ranges::find(parts, k) == parts.end() && middle.z() > things_[floor].bottom &&
             middle.z() < top && is_inside(hull, middle.head<2>());
    };
    std::size_t held = 0;
    for (std::size_t k = 0; k < things_.size(); ++k) held += is_held(k) ? 1U : 0U;
    if (held < fewest) parts.clear();
    return parts;
  }
  bool touch(std::size_t a, std::size_t b) const {
    constexpr Index fewest = 10;  // pairs of voxels
    const auto contact =
        contacts_.find(std::minmax(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)));
    return contact != contacts_.end() && contact->second >= fewest;
  }
  std::size_t size_of(std::size_t k) const { return things_[k].voxels.size(); }
  Index example_of(std::size_t k) const { return things_[k].voxels.front(); }
  std::size_t count() const { return things_.size(); }

 private:
  void measure(Thing& thing, std::vector<Eigen::Vector3d>& places) const {
    for (const Eigen::Vector3d& p : places) {
      thing.plan.emplace_back(p.head<2>());
      thing.middle += p;
    }
    thing.plan = hull_of(std::move(thing.plan));
    thing.middle /= static_cast<double>(places.size());
    thing.top = upper_end_of(places, 0).top;
    for (Eigen::Vector3d& p : places) p = -p;
    thing.bottom = -upper_end_of(places, 0).top;
    thing.plane = plane_through(scene_.vertices, scene_.normals, thing.voxels, scene_.viewpoint);
    if (thing.plane && thing.plane->share < kLeastShareOnSurface) thing.plane.reset();
  }
  bool is_wall_of(std::size_t wall, std::size_t floor) const {
    constexpr double largest_cosine = 0.5;  // of the angle with the support
    const std::optional<Plane>& plane = things_[wall].plane;
    if (!plane || std::abs(cosine_between(*plane, *scene_.plane)) > largest_cosine) return false;
    if (!touch(wall, floor)) return false;
    return count_behind(*plane, things_[floor].voxels) <=
           kMostBehind * static_cast<double>(size_of(floor));
  }

  /// The number of voxels that are behind a plane and beyond its margin.
  double count_behind(const Plane& plane, const std::vector<Index>& voxels) const {
    const Eigen::Vector3d eye(scene_.viewpoint.data());
    return static_cast<double>(std::ranges::count_if(voxels, [&](Index v) {
      const Eigen::Vector3d p = as_matrix(scene_.vertices).row(v).transpose();
      return plane.signed_distance(p.x(), p.y(), p.z()) < -kOfWalls.at((p - eye).squaredNorm());
    }));
  }

  const SceneTree& scene_;
  std::vector<Thing> things_;
  // For each pair of objects, the number of pairs of voxels that are near each other.
  std::map<std::pair<std::uint32_t, std::uint32_t>, Index> contacts_;
};

}  // namespace

std::vector<Index> join_containers(const SceneTree& scene, const Surface& surface, Index min_size,
                                   std::vector<Index>& object_of) {
  std::vector<Index> found;
  if (!scene.plane) return found;
  const Parts objects = number_parts(object_of, min_size);
  constexpr std::size_t fewest = 4;  // a container and three things in it
  if (objects.count() < fewest) return found;
  const Containers containers(scene, surface, objects);
  std::vector<std::size_t> largest_first(objects.count());
  std::iota(largest_first.begin(), largest_first.end(), 0U);
  std::ranges::stable_sort(largest_first, std::ranges::greater{},
                           [&](std::size_t k) { return containers.size_of(k); });
  std::vector<std::size_t> container_of(objects.count());
  std::iota(container_of.begin(), container_of.end(), 0U);
  std::vector<std::size_t> floors;
  for (const std::size_t k : largest_first) {
    if (container_of[k] != k) continue;
    const std::vector<std::size_t> parts = containers.container_of(k);
    if (parts.empty()) continue;
    // Two walls that are one part surround the objects as well; they belong to the floor.
    const auto same =
        std::ranges::find_if(floors, [&](std::size_t floor) { return containers.touch(floor, k); });
    const std::size_t floor = same == floors.end() ? k : *same;
    for (const std::size_t part : parts) container_of[part] = floor;
    if (floor == k) floors.push_back(k);
  }
  for (const std::size_t floor : floors) found.push_back(containers.example_of(floor));
  if (found.empty()) return found;
  for (std::size_t v = 0; v < object_of.size(); ++v)
    if (objects.of[v] != Parts::kSmall)
      object_of[v] =
          object_of[static_cast<std::size_t>(containers.example_of(container_of[objects.of[v]]))];
  return found;
}

}  // namespace ph::segment
