// SPDX-License-Identifier: MIT
#include "libsegment/src/scene/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libsegment/src/voxels/voxel_grid.hpp"
#include "ph/error.hpp"

namespace ph::segment {
namespace {

void require(bool condition, Setting setting, double found, std::string_view expected) {
  if (condition) return;
  throw Error(ErrorKind::usage,
              fmt::format("{}: found {}, expected {}", mark(setting), found, expected));
}

void require_finite(const Vec3& v, Setting setting) {
  for (const double x : v) require(std::isfinite(x), setting, x, "finite coordinates");
}

}  // namespace

void validate(const CloudView& cloud, const SegmentOptions& o) {
  if (cloud.stride < 3)
    throw Error(
        ErrorKind::bad_data,
        fmt::format("found a stride of {}, expected at least 3 floats per point", cloud.stride));
  const std::size_t count = cloud.xyz.size();
  if (count != 0 && (count < 3 || (count - 3) % cloud.stride != 0)) {
    throw Error(
        ErrorKind::bad_data,
        cloud.stride == 3
            ? fmt::format("found {} coordinates, expected a multiple of 3: three per point", count)
            : fmt::format(
                  "found {} floats, expected 3 for the last point and {} for each point before it",
                  count, cloud.stride));
  }
  const auto points = static_cast<Index>(cloud.size());
  // The check divides, because a product might overflow.
  if (cloud.width < 0 ||
      (cloud.width > 0 && (points % cloud.width != 0 || points / cloud.width != cloud.height))) {
    throw Error(ErrorKind::bad_data, fmt::format("found {} points, expected {} rows of {}", points,
                                                 cloud.height, cloud.width));
  }
  constexpr std::string_view kLength = "a positive finite length";
  const double voxel = o.voxel_size(), margin = o.plane_margin();
  require(voxel >= kLeastVoxel && voxel <= kMostVoxel, Setting::voxel, voxel,
          fmt::format("a length from {} to {}", kLeastVoxel, kMostVoxel));
  require(std::isfinite(o.distance) && o.distance >= 0, Setting::distance, o.distance,
          "a finite length of at least 0");
  require(o.steps >= 0, Setting::steps, o.steps, "at least 0");
  require(o.max_range >= 0, Setting::max_range, o.max_range, "a length of at least 0 or infinity");
  require(o.most_supports >= 1, Setting::most_supports, static_cast<double>(o.most_supports),
          "at least 1");
  require(std::isfinite(o.plane_noise) && o.plane_noise >= 0, Setting::plane_noise, o.plane_noise,
          "a finite length of at least 0");
  // With a smaller spacing, nearly every voxel would be a seed, and each supervoxel would have one
  // voxel.
  require(o.method != Method::supervoxels || (std::isfinite(o.spacing) && o.spacing >= voxel),
          Setting::spacing, o.spacing,
          fmt::format("a finite length of at least a voxel, {}", voxel));
  const CutOptions cut = o.cut();
  require(cut.value >= 0, Setting::min_persistence, cut.value, "at least 0");
  require(cut.min_part >= 1, Setting::min_part, static_cast<double>(cut.min_part), "at least 1");
  require(cut.min_size >= 1, Setting::min_size, static_cast<double>(cut.min_size), "at least 1");
  require(std::isfinite(margin) && margin > 0, Setting::plane_distance, margin, kLength);
  require_finite(o.viewpoint.value_or(cloud.viewpoint), Setting::viewpoint);
  if (o.plane_guess) {
    const auto& [x, y, z] = o.plane_guess->normal;
    const double length = std::hypot(x, y, z);
    constexpr double rounding = 1e-6;
    require(std::abs(length - 1) <= rounding, Setting::plane_guess, length, "a normal of length 1");
    require(std::isfinite(o.plane_guess->offset), Setting::plane_guess, o.plane_guess->offset,
            "a finite offset");
  }
  if (!o.crop) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    require(o.crop->min[axis] <= o.crop->max[axis], Setting::crop, o.crop->min[axis],
            fmt::format("at most {}, the other end of axis {}; the two ends of x come first, then "
                        "the ends of y and of z",
                        o.crop->max[axis], "xyz"[axis]));
  }
}

void validate(const SceneTree& scene) {
  const auto fail = [](std::string_view what, auto found, auto expected) {
    throw Error(ErrorKind::bad_data,
                fmt::format("scene: {}: found {}, expected {}", what, found, expected));
  };
  const auto expect = [&](std::string_view what, std::size_t found, std::size_t expected) {
    if (found != expected) fail(what, found, expected);
  };
  const std::size_t vertices = scene.cells.size(), points = scene.points.size();
  const bool is_paper = scene.method == Method::paper;
  expect("centroids", static_cast<std::size_t>(scene.vertices.size()), 3 * vertices);
  expect("coordinates of a centroid", static_cast<std::size_t>(scene.vertices.cols()), 3);
  expect("numbers of normals", static_cast<std::size_t>(scene.normals.size()),
         is_paper ? 0 : 3 * vertices);
  expect("counts", scene.counts.size(), vertices);
  expect("births", scene.merge_tree.births.size(), vertices);
  expect("vertices of points", scene.vertex_of_point.size(), points);
  expect("coordinates", scene.xyz.size(), 3 * points);
  if (scene.surfaces.size() > kMostSurfaces || scene.removed < 0 ||
      scene.removed > std::ssize(scene.surfaces))
    fail("numbers of surfaces and of removed surfaces",
         fmt::format("{}, {}", scene.surfaces.size(), scene.removed),
         fmt::format("at most {} surfaces, and no more removed surfaces than surfaces",
                     kMostSurfaces));
  Index size = 0;
  if (scene.width < 0 || scene.height < 0 ||
      __builtin_mul_overflow(scene.width, scene.height, &size))
    fail("size of the cloud", fmt::format("{} x {}", scene.width, scene.height),
         "a number of points");
  expect("marks of points", scene.removed_with.size(), static_cast<std::size_t>(size));
  for (const std::uint8_t surface : scene.removed_with)
    if (surface > scene.removed)
      fail("mark of a point", int{surface}, fmt::format("at most {}", scene.removed));
  for (Index last = -1; const Index i : scene.points) {
    if (i <= last || i >= size) fail("points", i, fmt::format("ascending, below {}", size));
    last = i;
  }
  for (const std::uint32_t v : scene.vertex_of_point)
    if (v >= vertices) fail("vertex of a point", v, fmt::format("one below {}", vertices));
  for (const Merge& m : scene.merge_tree.merges)
    for (const Index v : {m.u, m.v, m.elder, m.younger})
      if (v < 0 || std::cmp_greater_equal(v, vertices))
        fail("vertex of a merge", v, fmt::format("one of {}", vertices));
}

void validate(const SceneTree& scene, const SceneCut& cut) {
  validate(scene);
  const auto expect = [&](std::string_view what, std::size_t found, std::size_t expected) {
    if (found != expected)
      throw Error(
          ErrorKind::bad_data,
          fmt::format("cut: {}: found {}, expected {}, as in the scene", what, found, expected));
  };
  expect("labels", cut.labels.size(), scene.cloud_size());
  expect("labels of surfaces", cut.surface_labels.size(), scene.cloud_size());
  expect("labels of vertices", cut.vertex_labels.size(), scene.cells.size());
  for (const auto* labels : {&cut.labels, &cut.vertex_labels})
    for (const std::uint32_t label : *labels)
      if (label > cut.segments.size())
        throw Error(ErrorKind::bad_data, fmt::format("cut: label: found {}, expected at most {}",
                                                     label, cut.segments.size()));
  const auto require_surface = [&](std::uint32_t number) {
    if (number > scene.surfaces.size())
      throw Error(ErrorKind::bad_data, fmt::format("cut: surface: found {}, expected at most {}",
                                                   number, scene.surfaces.size()));
  };
  for (const std::uint8_t surface : cut.surface_labels) require_surface(surface);
  for (const Segment& segment : cut.segments) {
    require_surface(segment.on.surface);
    if (segment.on.segment > cut.segments.size())
      throw Error(ErrorKind::bad_data, fmt::format("cut: on: found segment {}, expected at most {}",
                                                   segment.on.segment, cut.segments.size()));
  }
}

void validate(const SceneTree& scene, const CutOptions& o) {
  validate(scene);
  require(o.value >= 0, Setting::cut, o.value, "at least 0");
  require(scene.method != Method::paper || o.value <= scene.distance, Setting::cut, o.value,
          fmt::format("at most {}, the distance up to which the tree was made", scene.distance));
  require(o.min_part >= 1, Setting::min_part, static_cast<double>(o.min_part), "at least 1");
  require(o.min_size >= 1, Setting::min_size, static_cast<double>(o.min_size), "at least 1");
}

}  // namespace ph::segment
