// SPDX-License-Identifier: MIT
#include "ph/voxel_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <utility>

#include "ph/barcode.hpp"
#include "ph/cubical.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

/// The lower envelope of the parabolas (x - q)² + f(q), with one parabola for each integer q. It is
/// computed for one line of the image at a time.
class Envelope {
 public:
  Envelope(std::size_t length, std::pmr::memory_resource* memory)
      : heights_(length, memory), sites_(length, memory), starts_(length, memory) {}

  /// Replaces each f(p) by the minimum over q of (p - q)² + f(q). If f is infinite everywhere, it
  /// stays infinite.
  void transform(double* line, std::size_t stride, Ticker& ticker) {
    const std::size_t length = heights_.size();
    std::size_t count = 0;
    for (std::size_t q = 0; q < length; ++q) {
      ticker.work();
      heights_[q] = line[q * stride];
      if (heights_[q] == kInfinity) continue;
      double start = -kInfinity;
      while (count > 0) {
        start = crossing(sites_[count - 1], q);
        if (start > starts_[count - 1]) break;
        --count;
        start = -kInfinity;
      }
      sites_[count] = q;
      starts_[count++] = start;
    }
    if (count == 0) {
      ticker.tick(length);
      return;
    }
    for (std::size_t p = 0, k = 0; p < length; ++p) {
      ticker.tick();
      while (k + 1 < count && starts_[k + 1] < static_cast<double>(p)) ++k;
      const double d = static_cast<double>(p) - static_cast<double>(sites_[k]);
      line[p * stride] = d * d + heights_[sites_[k]];
    }
  }

 private:
  /// To the right of this point, the parabola of q is below the parabola of p. Precondition: q > p.
  double crossing(std::size_t p, std::size_t q) const {
    const auto a = static_cast<double>(p), b = static_cast<double>(q);
    return ((heights_[q] + b * b) - (heights_[p] + a * a)) / (2 * (b - a));
  }

  std::pmr::vector<double> heights_;
  // The integers q whose parabolas form the envelope, from left to right.
  std::pmr::vector<std::size_t> sites_;
  std::pmr::vector<double> starts_;  // for each parabola, the point where it becomes the lowest
};

void check(PointsView points, double voxel, Index margin) {
  if (!(voxel > 0) || !std::isfinite(voxel))
    throw Error(ErrorKind::usage,
                fmt::format("voxel: found {}, expected a finite number above 0", voxel));
  if (margin < 0)
    throw Error(ErrorKind::usage, fmt::format("margin: found {}, expected 0 or more", margin));
  if (points.cols() < 1 || points.cols() > Cubical::kMaxDim) {
    throw Error(ErrorKind::usage, fmt::format("points: found {} coordinates, expected 1 to {}",
                                              points.cols(), Cubical::kMaxDim));
  }
  if (points.rows() == 0)
    throw Error(ErrorKind::bad_data, "points: found none, expected at least one");
  for (Index i = 0; i < points.rows(); ++i)
    for (Index k = 0; k < points.cols(); ++k)
      if (!std::isfinite(points(i, k)))
        throw Error(ErrorKind::bad_data, "points: found a coordinate that is not finite");
}

/// The grid of voxels around a set of points.
class Grid {
 public:
  Grid(PointsView points, double voxel, Index margin)
      : voxel_(voxel), margin_(static_cast<double>(margin)) {
    double size = 1;
    for (Index k = 0; k < points.cols(); ++k) {
      double low = points(0, k), high = low;
      for (Index i = 1; i < points.rows(); ++i) {
        low = std::min(low, points(i, k));
        high = std::max(high, points(i, k));
      }
      low_.push_back(low);
      const double extent = std::floor((high - low) / voxel) + 1 + 2 * margin_;
      size *= extent;
      if (!(size < 4294967295.0))
        throw Error(ErrorKind::resource,
                    fmt::format("voxel: found {}, which makes an image of more than 2^32 - 2 "
                                "voxels; use a larger voxel",
                                voxel));
      extents_.push_back(static_cast<Index>(extent));
    }
    size_ = static_cast<std::size_t>(size);
    strides_.assign(extents_.size(), 1);
    for (std::size_t k = strides_.size() - 1; k > 0; --k)
      strides_[k - 1] = strides_[k] * static_cast<std::size_t>(extents_[k]);
  }

  std::size_t size() const { return size_; }
  const std::vector<Index>& extents() const { return extents_; }
  std::size_t stride(std::size_t axis) const { return strides_[axis]; }
  /// The centre of the voxel at (0, ..., 0).
  std::vector<double> first() const {
    std::vector<double> centre;
    for (const double low : low_) centre.push_back(low + (0.5 - margin_) * voxel_);
    return centre;
  }
  /// The voxel that holds a point.
  std::size_t voxel_of(PointsView points, Index point) const {
    std::size_t at = 0;
    for (std::size_t k = 0; k < strides_.size(); ++k) {
      const double x = points(point, static_cast<Index>(k));
      at += static_cast<std::size_t>(std::floor((x - low_[k]) / voxel_) + margin_) * strides_[k];
    }
    return at;
  }

 private:
  std::vector<double> low_;
  double voxel_, margin_;
  std::vector<Index> extents_;
  std::vector<std::size_t> strides_;
  std::size_t size_ = 0;
};

/// Replaces each value by the distance to the nearest voxel of value 0. All values must be 0 or
/// infinity.
void make_distances(const Grid& grid, double voxel, std::vector<double>& values, Ticker& ticker,
                    std::pmr::memory_resource* memory) {
  for (std::size_t k = 0; k < grid.extents().size(); ++k) {
    const auto length = static_cast<std::size_t>(grid.extents()[k]);
    const std::size_t stride = grid.stride(k);
    Envelope envelope(length, memory);
    for (std::size_t slab = 0; slab < values.size(); slab += length * stride)
      for (std::size_t line = slab; line < slab + stride; ++line)
        envelope.transform(&values[line], stride, ticker);
  }
  for (double& value : values) {
    ticker.work();
    value = voxel * std::sqrt(value);
  }
}

}  // namespace

PointImage voxel_image(PointsView points, double voxel, VoxelValue value, Index margin,
                       const RunContext& context) {
  check(points, voxel, margin);
  const Grid grid(points, voxel, margin);
  const MemoryClaim claim(context.memory, grid.size() * sizeof(double));
  Ticker ticker(context, "voxels", grid.size() * grid.extents().size());
  std::vector<double> values;
  values.reserve(grid.size());
  constexpr std::size_t block = 1 << 12;
  while (values.size() < grid.size()) {
    values.insert(values.end(), std::min(block, grid.size() - values.size()), kInfinity);
    ticker.work(block);
  }
  for (Index i = 0; i < points.rows(); ++i) {
    ticker.work();
    double& found = values[grid.voxel_of(points, i)];
    if (found == kInfinity) found = 0;
    if (value == VoxelValue::density) --found;
  }
  const bool masked = value != VoxelValue::distance;
  // mutant: absent-voxels
  if (masked) std::ranges::replace(values, kInfinity, std::numeric_limits<double>::quiet_NaN());
  if (value == VoxelValue::distance) make_distances(grid, voxel, values, ticker, &context.memory);
  PointImage result{{}, grid.first(), voxel};
  result.image.extents = grid.extents();
  result.image.values = std::move(values);
  result.image.masked = masked;
  return result;
}

}  // namespace ph
