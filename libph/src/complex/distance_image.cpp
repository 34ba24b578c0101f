// SPDX-License-Identifier: MIT
#include "ph/complex/distance_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <utility>

#include "ph/complex/cubical.hpp"
#include "ph/core/barcode.hpp"
#include "ph/core/error.hpp"

namespace ph {
namespace {

/// The lower envelope of parabolas x² + height at whole numbers, one line of the image at a time.
class Envelope {
 public:
  Envelope(std::size_t length, std::pmr::memory_resource* memory)
      : heights_(length, memory), sites_(length, memory), starts_(length, memory) {}

  /// Replaces f by min over q of (p - q)² + f(q). Infinite where f is infinite everywhere.
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
  /// Where the parabola of q, on the right, falls below that of p.
  double crossing(std::size_t p, std::size_t q) const {
    const auto a = static_cast<double>(p), b = static_cast<double>(q);
    return ((heights_[q] + b * b) - (heights_[p] + a * a)) / (2 * (b - a));
  }

  std::pmr::vector<double> heights_;
  std::pmr::vector<std::size_t> sites_;  // of the parabolas of the envelope, from left to right
  std::pmr::vector<double> starts_;      // where each is the lowest one from
};

void check(const Points& points, double voxel, Index margin) {
  if (!(voxel > 0) || !std::isfinite(voxel))
    throw Error(ErrorKind::usage, fmt::format("voxel: found {}, expected more than 0", voxel));
  if (margin < 0)
    throw Error(ErrorKind::usage, fmt::format("margin: found {}, expected 0 or more", margin));
  if (points.cols() < 1 || points.cols() > Cubical::kMaxDim) {
    throw Error(ErrorKind::usage, fmt::format("points: found {} coordinates, expected 1 to {}",
                                              points.cols(), Cubical::kMaxDim));
  }
  if (points.rows() == 0) throw Error(ErrorKind::bad_data, "an image of no points");
  if (!points.allFinite())
    throw Error(ErrorKind::bad_data, "points: found a coordinate that is not finite");
}

}  // namespace

PointImage distance_image(const Points& points, double voxel, Index margin,
                          const RunContext& context) {
  check(points, voxel, margin);
  const Eigen::RowVectorXd low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
  PointImage result{{}, {}, voxel};
  std::vector<std::size_t> strides(static_cast<std::size_t>(points.cols()), 1);
  double size = 1;
  for (Index k = 0; k < points.cols(); ++k) {
    const double extent =
        std::floor((high[k] - low[k]) / voxel) + 1 + 2 * static_cast<double>(margin);
    size *= extent;
    if (!(size < 4294967295.0))
      throw Error(ErrorKind::resource,
                  fmt::format("voxels of {} make an image of more than 2^32 - 2 voxels", voxel));
    result.image.extents.push_back(static_cast<Index>(extent));
    result.first.push_back(low[k] + (0.5 - static_cast<double>(margin)) * voxel);
  }
  for (std::size_t k = strides.size() - 1; k > 0; --k)
    strides[k - 1] = strides[k] * static_cast<std::size_t>(result.image.extents[k]);

  const MemoryClaim claim(context.memory, static_cast<std::size_t>(size) * sizeof(double));
  const auto voxels = static_cast<std::size_t>(size);
  Ticker ticker(context, "distance", voxels * strides.size());
  std::vector<double> squares;
  squares.reserve(voxels);
  constexpr std::size_t block = 1 << 12;
  while (squares.size() < voxels) {
    squares.insert(squares.end(), std::min(block, voxels - squares.size()), kInfinity);
    ticker.work(block);
  }
  for (Index i = 0; i < points.rows(); ++i) {
    ticker.work();
    std::size_t at = 0;
    for (Index k = 0; k < points.cols(); ++k) {
      const double cell = std::floor((points(i, k) - low[k]) / voxel) + static_cast<double>(margin);
      at += static_cast<std::size_t>(cell) * strides[static_cast<std::size_t>(k)];
    }
    squares[at] = 0;
  }
  for (std::size_t k = 0; k < strides.size(); ++k) {
    const auto length = static_cast<std::size_t>(result.image.extents[k]);
    Envelope envelope(length, &context.memory);
    for (std::size_t slab = 0; slab < squares.size(); slab += length * strides[k])
      for (std::size_t line = slab; line < slab + strides[k]; ++line)
        envelope.transform(&squares[line], strides[k], ticker);
  }
  for (double& value : squares) {
    ticker.work();
    value = voxel * std::sqrt(value);
  }
  result.image.values = std::move(squares);
  return result;
}

}  // namespace ph
