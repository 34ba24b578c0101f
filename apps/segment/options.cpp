// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <fmt/format.h>

#include <cmath>

#include "ph/core/error.hpp"
#include "voxel_grid.hpp"

namespace ph::segment {
namespace {

void require(bool condition, std::string_view name, double found, std::string_view expected) {
  if (condition) return;
  throw Error(ErrorKind::usage, fmt::format("{}: found {}, expected {}", name, found, expected));
}

void require_finite(const Vec3& v, std::string_view name) {
  for (const double x : v) require(std::isfinite(x), name, x, "finite coordinates");
}

}  // namespace

void validate(const CloudView& cloud, const SegmentOptions& o) {
  if (cloud.xyz.size() % 3 != 0) {
    throw Error(ErrorKind::bad_data,
                fmt::format("found {} coordinates, expected three a point", cloud.xyz.size()));
  }
  const auto points = static_cast<Index>(cloud.xyz.size() / 3);
  // Divided, for a product might overflow.
  if (cloud.width < 0 ||
      (cloud.width > 0 && (points % cloud.width != 0 || points / cloud.width != cloud.height))) {
    throw Error(ErrorKind::bad_data, fmt::format("found {} points, expected {} rows of {}", points,
                                                 cloud.height, cloud.width));
  }
  constexpr std::string_view kLength = "a positive finite length";
  const double voxel = o.voxel_size(), margin = o.plane_margin();
  require(voxel >= kLeastVoxel && voxel <= kMostVoxel, "voxel", voxel,
          fmt::format("a length from {} to {}", kLeastVoxel, kMostVoxel));
  require(std::isfinite(o.distance) && o.distance >= 0, "distance", o.distance,
          "a finite length of at least 0");
  require(o.steps >= 0, "steps", o.steps, "at least 0");
  require(o.max_range >= 0, "max_range", o.max_range, "a length of at least 0 or infinity");
  require(std::isfinite(o.plane_noise) && o.plane_noise >= 0, "plane_noise", o.plane_noise,
          "a finite length of at least 0");
  // Nearly every voxel would be a seed: supervoxels of a voxel each.
  require(o.method != Method::supervoxels || (std::isfinite(o.spacing) && o.spacing >= voxel),
          "spacing", o.spacing, fmt::format("a finite length of at least a voxel, {}", voxel));
  const CutOptions cut = o.cut();
  require(cut.value >= 0, "min_persistence", cut.value, "at least 0");
  require(cut.min_part >= 1, "min_part", static_cast<double>(cut.min_part), "at least 1");
  require(cut.min_size >= 1, "min_size", static_cast<double>(cut.min_size), "at least 1");
  require(std::isfinite(margin) && margin > 0, "plane_distance", margin, kLength);
  require_finite(o.viewpoint.value_or(cloud.viewpoint), "viewpoint");
  if (!o.crop) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    require(o.crop->min[axis] <= o.crop->max[axis], "crop", o.crop->min[axis],
            fmt::format("at most {}, the other end", o.crop->max[axis]));
  }
}

void validate(const SceneTree& scene, const CutOptions& o) {
  require(o.value >= 0, "cut", o.value, "at least 0");
  require(scene.method != Method::paper || o.value <= scene.distance, "cut", o.value,
          fmt::format("at most {}, the distance up to which the tree was made", scene.distance));
  require(o.min_part >= 1, "min_part", static_cast<double>(o.min_part), "at least 1");
  require(o.min_size >= 1, "min_size", static_cast<double>(o.min_size), "at least 1");
}

}  // namespace ph::segment
