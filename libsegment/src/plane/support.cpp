// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>
#include <vector>

#include "libsegment/src/plane/extent.hpp"
#include "libsegment/src/plane/plane.hpp"
#include "libsegment/src/plane/sample.hpp"

namespace ph::segment {
namespace {

// The side of a square, in metres; beyond one metre, per metre.
constexpr double kSide = 0.05, kFineSide = 0.02;

/// The extent of a plane in a sample.
Extent extent_of(const PlaneSearch& search, const Sample& sample, double side = kSide) {
  Extent extent(*search.plane, side * std::max(1.0, search.range));
  for (std::size_t i = 0; i < sample.size(); ++i) extent.add(sample[i], sample.limits[i]);
  return extent;
}

/// The largest planes of a sample, without faces of objects. @param first the largest one. @param
/// things receives the points that are on none of them.
std::vector<PlaneSearch> planes_of(const PlaneSearch& first, const Sample& sample,
                                   const Vec3& viewpoint, Sample& things) {
  constexpr int most_times = 8;
  constexpr double least_share = 0.01;
  std::vector<PlaneSearch> planes{first};
  Sample rest = points_off(*first.plane, kMarginsOfPlane, sample);
  things = rest;
  for (int times = 1; times < most_times; ++times) {
    PlaneSearch next = find_plane(rest, viewpoint);
    if (!next.plane) break;
    next.plane->share *= static_cast<double>(rest.size()) / static_cast<double>(sample.size());
    if (next.plane->share < least_share) break;
    rest = points_off(*next.plane, kMarginsOfPlane, rest);
    // A wall beside a table is not the table's other side.
    const Extent extent = extent_of(next, things);  // mutant: support-beside
    if (extent.area() < kLeastTable || extent.goes_on_behind()) continue;
    things = points_off(*next.plane, kMarginsOfPlane, things);
    planes.push_back(std::move(next));
  }
  return planes;
}

/// Adds, for each plane, the largest plane that is parallel to it, if it is as large as a table. A
/// table far away holds few points of the sample, but its direction is known from the floor.
void add_parallel(const Sample& sample, const Vec3& viewpoint, std::vector<PlaneSearch>& planes,
                  Sample& things) {
  for (std::size_t i = 0, count = planes.size(); i < count; ++i) {
    PlaneSearch search = find_parallel(*planes[i].plane, things, viewpoint);
    if (!search.plane) continue;
    const Extent extent = extent_of(search, sample);
    if (extent.goes_on_behind() || extent.area_of_hull() < kLeastTable) continue;
    search.plane->share *= static_cast<double>(things.size()) / static_cast<double>(sample.size());
    things = points_off(*search.plane, kMarginsOfPlane, things);
    planes.push_back(std::move(search));
  }
}

/// The number of points of things that are just in front of a plane.
std::size_t count_contacts(const Plane& plane, const Sample& things) {
  constexpr double least_reach = 0.03;  // metres
  std::size_t count = 0;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const double height = plane.signed_distance(things.x[i], things.y[i], things.z[i]);
    const double least = kMarginsOfPlane * things.limits[i];
    count += height > least && height < least + std::max(least, least_reach) ? 1U : 0U;
  }
  return count;
}

/// The plane on which most things stand. The contacts of planes that are parallel are added up,
/// because the things on a shelf stand on several boards.
std::size_t most_touched(const std::vector<PlaneSearch>& planes, const Sample& things) {
  std::vector<std::size_t> contacts;
  for (const PlaneSearch& search : planes)
    contacts.push_back(count_contacts(*search.plane, things));
  constexpr double least_share_of_support = 0.05;
  std::size_t best = 0, most = 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < planes.size(); ++k)
      if (cosine_between(*planes[i].plane, *planes[k].plane) >= kLeastOfParallel)
        count += contacts[k];
    if (count <= most || planes[i].plane->share < least_share_of_support) continue;
    most = count;
    best = i;
  }
  return best;
}

}  // namespace

SupportSearch find_support(const CloudView& cloud, const Sample& sample,
                           const std::optional<Plane>& guess) {
  PlaneSearch largest = find_plane(sample, cloud.viewpoint, guess);
  if (!largest.plane) return {std::move(largest), {}};
  const Extent extent = extent_of(largest, sample);
  if (extent.goes_on_behind())  // mutant: support-face
    return {{std::nullopt, "no plane: the surface goes on behind the largest candidate"}, {}};
  // mutant: support-alone
  if (extent.area() < kLeastTable && !extent_of(largest, sample, kFineSide).has_things_on_it())
    return {{std::nullopt,
             "no plane: the largest candidate is smaller than a table, and nothing is on it"},
            {}};
  Sample things;
  std::vector<PlaneSearch> planes = planes_of(largest, sample, cloud.viewpoint, things);
  // mutant: support-wall
  if (bounds_the_view(*largest.plane, cloud) && planes.size() > 1) {
    add_parallel(sample, cloud.viewpoint, planes, things);
    std::swap(planes.front(), planes[most_touched(planes, things)]);
  }
  SupportSearch search{std::move(planes.front()), {}};
  for (std::size_t k = 1; k < planes.size(); ++k) search.others.push_back(*planes[k].plane);
  return search;
}

}  // namespace ph::segment
