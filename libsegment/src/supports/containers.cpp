// SPDX-License-Identifier: MIT
#include "libsegment/src/supports/containers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "libsegment/src/plane/outline.hpp"
#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/scene/parts.hpp"
#include "libsegment/src/supports/planar.hpp"
#include "libsegment/src/vessels/upper_end.hpp"
#include "ph/detail/segment/bounds.hpp"
#include "ph/eigen.hpp"

namespace ph::segment {
namespace {

/// The distance of a point from the border of a hull of at least three points.
double distance_to_border(const Outline& hull, const Eigen::Vector2d& p) {
  double least = kInfinity;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d side = hull[(i + 1) % hull.size()] - hull[i];
    const double along = std::clamp((p - hull[i]).dot(side) / side.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - hull[i] - along * side).norm());
  }
  return least;
}

/// An object, upright: z is the height above the support.
struct Thing {
  std::vector<Index> voxels;
  Outline plan;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double top = 0, bottom = 0;
  std::optional<Plane> plane;  ///< the plane on which nearly all of it lies
};

/// @param hull at least three points.
bool is_inside(const Outline& hull, const Eigen::Vector2d& p) {
  for (std::size_t i = 0; i < hull.size(); ++i)
    if (cross(hull[(i + 1) % hull.size()] - hull[i], p - hull[i]) < 0) return false;
  return true;
}

class Containers {
 public:
  Containers(const SceneTree& scene, const Surface& surface, const Parts& objects)
      : scene_(scene), things_(objects.count()), touching_(things_.size()) {
    const Eigen::Matrix3d turn = upright(scene.plane->normal);
    std::vector<std::vector<Eigen::Vector3d>> places(things_.size());
    for (std::size_t v = 0; v < objects.of.size(); ++v) {
      if (objects.of[v] == Parts::kSmall) continue;
      things_[objects.of[v]].voxels.push_back(static_cast<Index>(v));
      places[objects.of[v]].emplace_back(
          turn * as_matrix(scene.vertices).row(static_cast<Index>(v)).transpose());
    }
    for (std::size_t k = 0; k < things_.size(); ++k) measure(things_[k], places[k]);
    std::set<std::pair<std::uint32_t, std::uint32_t>> contacts;
    for (const VoxelPair& pair : surface.pairs) {
      const std::uint32_t a = objects.of[pair.u], b = objects.of[pair.v];
      if (a != b && a != Parts::kSmall && b != Parts::kSmall) contacts.insert(std::minmax(a, b));
    }
    for (const auto& [a, b] : contacts) {
      touching_[a].push_back(b);
      touching_[b].push_back(a);
    }
    for (std::size_t k = 0; k < things_.size(); ++k) by_x_.push_back(k);
    std::ranges::sort(by_x_, {}, [&](std::size_t k) { return things_[k].middle.x(); });
  }

  /// The numbers of the objects that are one container, floor first, and of the objects in it.
  struct Found {
    std::vector<std::size_t> parts, objects;
  };
  /// The container with this floor. Empty if the object is no floor.
  std::optional<Found> container_on(std::size_t floor) const {
    constexpr std::size_t fewest = 3;  // mutant: container-fewest
    Found found{{floor}, {}};
    Outline plan = things_[floor].plan;
    double top = things_[floor].top;
    for (const std::size_t w : touching_[floor]) {
      if (!is_wall_of(w, floor)) continue;
      found.parts.push_back(w);
      plan.insert(plan.end(), things_[w].plan.begin(), things_[w].plan.end());
      top = std::max(top, things_[w].top);
    }
    const Outline hull = hull_of(std::move(plan));
    if (hull.size() < 3) return std::nullopt;  // nothing is inside a point or a line
    const auto x_of = [](const Eigen::Vector2d& p) { return p.x(); };
    const auto [left, right] = std::ranges::minmax(hull, {}, x_of);
    const auto middle_of = [&](std::size_t k) { return things_[k].middle.x(); };
    const auto first = std::ranges::lower_bound(by_x_, left.x(), {}, middle_of);
    const auto last = std::ranges::upper_bound(by_x_, right.x(), {}, middle_of);
    for (const std::size_t k : std::span(first, last)) {
      const Eigen::Vector3d& middle = things_[k].middle;
      if (std::ranges::find(found.parts, k) != found.parts.end() ||
          !is_inside(hull, middle.head<2>()))
        continue;
      // If all walls are one part, this part surrounds its floor.
      if (is_floor_of(k, hull) && middle.z() < things_[floor].top)
        found.parts.push_back(k);
      else if (middle.z() > things_[floor].bottom && middle.z() < top)  // mutant: container-top
        found.objects.push_back(k);
    }
    if (found.objects.size() < fewest) return std::nullopt;
    for (std::size_t k = 0; k < things_.size(); ++k)
      if (std::ranges::find(found.parts, k) == found.parts.end() && is_outside_of_wall(k, hull))
        found.parts.push_back(k);
    return found;
  }
  bool touch(std::size_t a, std::size_t b) const {
    return std::ranges::find(touching_[a], b) != touching_[a].end();
  }
  std::vector<std::size_t> largest_first() const {
    std::vector<std::size_t> order(things_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, std::ranges::greater{},
                             [&](std::size_t k) { return things_[k].voxels.size(); });
    return order;
  }
  Index vertex_of(std::size_t k) const { return things_[k].voxels.front(); }

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
  /// @param wall an object that touches the floor.
  bool is_wall_of(std::size_t wall, std::size_t floor) const {
    const std::optional<Plane>& plane = things_[wall].plane;
    if (!plane || !is_steep(*plane, *scene_.plane)) return false;
    const std::vector<Index>& voxels = things_[floor].voxels;
    return count_behind(*plane, voxels) <= kMostBehind * static_cast<double>(voxels.size());
  }
  /// True if an object is flat, parallel to the support, and covers most of a container.
  bool is_floor_of(std::size_t k, const Outline& hull) const {
    const Thing& thing = things_[k];
    return thing.plane && cosine_between(*thing.plane, *scene_.plane) > kLeastOfParallel &&
           2 * area_of(thing.plan) > area_of(hull);  // mutant: container-floor
  }
  /// True if an object is flat and steep and follows the border of a container. The outside of a
  /// wall does not touch its inside, because the rim between them is too thin to be seen.
  bool is_outside_of_wall(std::size_t k, const Outline& hull) const {
    constexpr double thickest = 0.02;  // metres
    const Thing& thing = things_[k];
    const auto is_at_border = [&](const Eigen::Vector2d& p) {
      return distance_to_border(hull, p) <= thickest;  // mutant: container-outside
    };
    return thing.plane && is_steep(*thing.plane, *scene_.plane) &&
           std::ranges::all_of(thing.plan, is_at_border);
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
  std::vector<std::vector<std::size_t>> touching_;  // for each object, the objects that it touches
  std::vector<std::size_t> by_x_;                   // the objects, ordered by x of their middles
};

}  // namespace

std::vector<Container> join_containers(const SceneTree& scene, const Surface& surface,
                                       Index min_size, std::vector<Index>& object_of) {
  if (!scene.plane) return {};
  const Parts objects = number_parts(object_of, min_size);
  const Containers things(scene, surface, objects);
  // For each object, the floor of its container, or the object itself.
  std::vector<std::size_t> floor_of(objects.count());
  std::iota(floor_of.begin(), floor_of.end(), 0U);
  std::vector<std::size_t> floors;
  std::vector<std::vector<std::size_t>> contents(objects.count());
  for (const std::size_t k : things.largest_first()) {
    if (floor_of[k] != k) continue;
    const auto found = things.container_on(k);
    if (!found) continue;
    // Two walls that are one part surround the objects as well. They belong to the floor.
    const auto same =
        std::ranges::find_if(floors, [&](std::size_t f) { return things.touch(f, k); });
    const std::size_t floor = same == floors.end() ? k : *same;
    if (floor == k) floors.push_back(k);
    for (const std::size_t part : found->parts)
      if (part == k || (floor_of[part] == part && std::ranges::find(floors, part) == floors.end()))
        floor_of[part] = floor;  // a part stays in the container in which it is already
    contents[floor].insert(contents[floor].end(), found->objects.begin(), found->objects.end());
  }
  for (std::size_t v = 0; v < object_of.size() && !floors.empty(); ++v)
    if (objects.of[v] != Parts::kSmall && floor_of[objects.of[v]] != objects.of[v])
      object_of[v] = object_of[static_cast<std::size_t>(things.vertex_of(floor_of[objects.of[v]]))];
  std::vector<Container> containers;
  for (const std::size_t floor : floors) {
    Container& container = containers.emplace_back(Container{things.vertex_of(floor), {}});
    for (const std::size_t k : contents[floor])
      if (floor_of[k] != floor) container.objects.push_back(things.vertex_of(k));
  }
  return containers;
}

void set_containers(std::span<const Container> containers, SceneCut& cut) {
  const auto label_of = [&](Index v) { return cut.vertex_labels[static_cast<std::size_t>(v)]; };
  for (const Container& container : containers) {
    const std::uint32_t label = label_of(container.vertex);
    if (label == 0) continue;
    cut.segments[label - 1].role = Role::container;
    for (const Index v : container.objects)
      if (const std::uint32_t in = label_of(v); in != 0 && cut.segments[in - 1].on.segment == 0)
        cut.segments[in - 1].on = {0, label};
  }
}

}  // namespace ph::segment
