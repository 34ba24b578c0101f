// SPDX-License-Identifier: MIT
#include "libsegment/src/objects/view.hpp"

#include <Eigen/Geometry>

#include "ph/eigen.hpp"

namespace ph::segment {

namespace {

/// The largest number of rows and of columns. Without this limit, a few objects that are far apart
/// would need a huge raster that is nearly empty.
constexpr double kMostASide = 1024;

}  // namespace

View::View(const Points& centroids, double voxel, const Vec3& viewpoint)
    : ranges_(static_cast<std::size_t>(centroids.rows())), places_(ranges_.size(), {-1, -1}) {
  constexpr double voxels_a_cell = 1.3;    // smaller cells leave gaps between neighbouring voxels
  constexpr double smallest_cosine = 0.2;  // the cosine of 78 degrees
  const Eigen::Vector3d eye(viewpoint[0], viewpoint[1], viewpoint[2]);
  const auto ray = [&](Voxel v) -> Eigen::Vector3d {
    return as_matrix(centroids).row(v).transpose() - eye;
  };
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  double sum = 0;
  for (Voxel v = 0; v < ranges_.size(); ++v) {
    ranges_[v] = ray(v).norm();
    sum += ranges_[v];
    if (ranges_[v] > 0) axis += ray(v) / ranges_[v];
  }
  if (!(axis.norm() > 0)) return;
  axis.normalize();
  const Eigen::Vector3d right = axis.unitOrthogonal(), down = axis.cross(right);
  double cell = voxels_a_cell * voxel * static_cast<double>(ranges_.size()) / sum;

  std::vector<Eigen::Vector2d> directions(ranges_.size());
  Eigen::Array2d low = Eigen::Array2d::Constant(kInfinity), high = -low;
  const auto is_seen = [&](Voxel v) {
    return ranges_[v] > 0 && ray(v).dot(axis) > smallest_cosine * ranges_[v];
  };
  for (Voxel v = 0; v < ranges_.size(); ++v) {
    if (!is_seen(v)) continue;
    const Eigen::Vector3d d = ray(v) / ray(v).dot(axis);
    directions[v] = {d.dot(right), d.dot(down)};
    low = low.min(directions[v].array());
    high = high.max(directions[v].array());
  }
  if (!(low <= high).all()) return;
  cell = std::max(cell, (high - low).maxCoeff() / kMostASide);
  // The viewpoint is so far away that all voxels are in one direction.
  if (!(cell > 0)) return;
  width_ = static_cast<std::size_t>((high - low)[0] / cell) + 1;
  height_ = static_cast<std::size_t>((high - low)[1] / cell) + 1;
  nearest_.assign(width_ * height_, kNone);
  for (Voxel v = 0; v < ranges_.size(); ++v) {
    if (!is_seen(v)) continue;
    const Eigen::Array2d place = (directions[v].array() - low) / cell;
    places_[v] = {place[0], place[1]};
    Voxel& first = nearest_[this->cell(place[0], place[1])];
    if (first == kNone || ranges_[v] < ranges_[first]) first = v;
  }
  find_least_ranges();
}

void View::find_least_ranges() {
  nearest_range_.reserve(nearest_.size());
  for (const Voxel v : nearest_) nearest_range_.push_back(v == kNone ? kInfinity : ranges_[v]);
  const auto least_along = [&](std::size_t at, std::size_t size, auto&& value) {
    double least = kInfinity;
    const Window near = window(at, size);
    for (std::size_t k = near.begin; k < near.end; ++k) least = std::min(least, value(k));
    return least;
  };
  std::vector<double> in_row(nearest_.size());
  for (std::size_t i = 0; i < nearest_.size(); ++i) {
    in_row[i] = least_along(i % width_, width_,
                            [&](std::size_t x) { return nearest_range_[i / width_ * width_ + x]; });
  }
  least_range_.resize(nearest_.size());
  for (std::size_t i = 0; i < nearest_.size(); ++i)
    least_range_[i] = least_along(i / width_, height_,
                                  [&](std::size_t y) { return in_row[y * width_ + i % width_]; });
}

}  // namespace ph::segment
