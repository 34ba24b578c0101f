// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
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

/// True if the points just behind a plane are farther from it than noise would put them on a plane
/// of this size. They are then on a curved surface, such as the wall of a can.
bool is_curved(const PlaneSearch& search, const Extent& extent) {
  constexpr double thickest = 0.1;  // as a share of the side of a square with the same area
  const double margin = kDeviations * search.noise * search.range * search.range;
  return margin > thickest * std::sqrt(extent.area());
}

/// Adds the largest planes of some points, without faces of objects. @param rest a sample of points
/// that are on none of the planes so far. @param share the share of these points among all points.
void add_planes(Sample rest, double share, const Vec3& viewpoint,
                std::vector<PlaneSearch>& planes) {
  constexpr int most_times = 8;
  const auto all = static_cast<double>(rest.size()) / share;
  Sample things = rest;
  for (int times = 1; times < most_times; ++times) {
    PlaneSearch next = find_plane(rest, viewpoint);
    if (!next.plane) break;
    next.plane->share *= static_cast<double>(rest.size()) / all;
    rest = points_off(*next.plane, kMarginsOfPlane, rest);
    // A wall beside a table is not the table's other side.
    const Extent extent = extent_of(next, things);  // mutant: support-beside
    if (extent.area() < kLeastTable || extent.goes_on_behind()) continue;
    things = points_off(*next.plane, kMarginsOfPlane, things);
    planes.push_back(std::move(next));
  }
}

/// The points that are on none of some planes.
std::vector<Index> points_off(const std::vector<PlaneSearch>& planes, const CloudView& cloud,
                              const std::vector<Index>& points, const PlaneMargin& margin) {
  std::vector<SlantedMargin> margins;
  for (const PlaneSearch& search : planes)
    margins.emplace_back(margin, *search.plane, cloud.viewpoint);
  std::vector<Index> off;
  for (const Index i : points) {
    const float* p = cloud.point(static_cast<std::size_t>(i));
    bool is_on = false;
    for (std::size_t k = 0; k < planes.size() && !is_on; ++k)
      is_on = std::abs(planes[k].plane->signed_distance(p[0], p[1], p[2])) <=
              kMarginsOfPlane * margins[k]({p[0], p[1], p[2]});
    if (!is_on) off.push_back(i);
  }
  return off;
}

/// How many points of things are in a layer just in front of a plane, per metre of its thickness.
/// The layer is as thick as the noise of the plane. A wall that is seen from the front has a
/// thicker layer than a floor that is seen at a slant, and more points of things far away are in
/// it.
double contacts_with(const Plane& plane, const SlantedMargin& margin, const Sample& things) {
  constexpr double least_reach = 0.03;  // metres
  double contacts = 0;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const double height = plane.signed_distance(things.x[i], things.y[i], things.z[i]);
    const double least = kMarginsOfPlane * margin(things[i]);
    const double reach = std::max(least, least_reach);
    if (height > least && height < least + reach) contacts += 1 / reach;
  }
  return contacts;
}

/// For each plane, its contacts and the contacts of the largest plane that is parallel to it. A
/// table far away may hold too few points to be found by itself, but its direction is known from
/// the floor. @param things a sample of the points off all planes.
std::vector<double> contacts_of(const std::vector<PlaneSearch>& planes, const PlaneMargin& margin,
                                const Vec3& viewpoint, Sample things) {
  std::vector<std::vector<Plane>> touched;
  for (const PlaneSearch& search : planes) {
    touched.push_back({*search.plane});
    things.set_limits(SlantedMargin(margin, *search.plane, viewpoint));
    const PlaneSearch parallel = find_parallel(*search.plane, things, viewpoint);
    if (!parallel.plane) continue;
    const Extent extent = extent_of(parallel, things);
    if (extent.goes_on_behind() || extent.area_of_hull() < kLeastTable) continue;
    touched.back().push_back(*parallel.plane);
    things = points_off(*parallel.plane, kMarginsOfPlane, things);
  }
  std::vector<double> contacts(planes.size());
  for (std::size_t k = 0; k < planes.size(); ++k)
    for (const Plane& plane : touched[k])
      contacts[k] += contacts_with(plane, SlantedMargin(margin, plane, viewpoint), things);
  return contacts;
}

/// The plane on which most things stand. The contacts of planes that are parallel are added up,
/// because the things on a shelf stand on several boards.
std::size_t most_touched(const std::vector<PlaneSearch>& planes,
                         const std::vector<double>& contacts) {
  constexpr double least_share_of_support = 0.05;
  std::size_t best = 0;
  double most = 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    double count = 0;
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

SupportSearch find_support(const CloudView& cloud, const std::vector<Index>& points,
                           const PlaneMargin& margin, const Sample& sample,
                           const std::optional<Plane>& guess) {
  PlaneSearch largest = find_plane(sample, cloud.viewpoint, guess);
  if (!largest.plane) return {std::move(largest), {}};
  const Extent extent = extent_of(largest, sample);
  if (extent.goes_on_behind())  // mutant: support-face
    return {{std::nullopt, "no plane: the surface goes on behind the largest candidate"}, {}};
  if (extent.area() < kLeastTable) {
    const Extent fine = extent_of(largest, sample, kFineSide);
    if (!fine.has_things_on_it())  // mutant: support-alone
      return {{std::nullopt,
               "no plane: the largest candidate is smaller than a table, and nothing is on it"},
              {}};
    if (is_curved(largest, fine))  // mutant: support-curved
      return {
          {std::nullopt,
           "no plane: the largest candidate is smaller than a table, and its surface is curved"},
          {}};
  }
  std::vector<PlaneSearch> planes{largest};
  const auto share_of = [](std::size_t some, std::size_t all) {
    return static_cast<double>(some) / static_cast<double>(all);
  };
  const Sample rest = points_off(*largest.plane, kMarginsOfPlane, sample);
  add_planes(rest, share_of(rest.size(), sample.size()), cloud.viewpoint, planes);
  // mutant: support-wall
  if (bounds_the_view(*largest.plane, cloud) && planes.size() > 1) {
    // In a room, few points of the first sample are on things.
    const std::vector<Index> off = points_off(planes, cloud, points, margin);
    const Sample things = draw_sample(cloud, off, margin);
    add_planes(things, share_of(off.size(), points.size()), cloud.viewpoint, planes);
    const auto contacts = contacts_of(planes, margin, cloud.viewpoint, things);
    std::swap(planes.front(), planes[most_touched(planes, contacts)]);
  }
  SupportSearch search{std::move(planes.front()), {}};
  for (std::size_t k = 1; k < planes.size(); ++k) search.others.push_back(*planes[k].plane);
  return search;
}

}  // namespace ph::segment
