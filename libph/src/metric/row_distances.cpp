// SPDX-License-Identifier: MIT
#include "ph/detail/metric/row_distances.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "libph/src/core/for_each_target.hpp"

namespace ph {
namespace {

// The number of points per block. It is so small that the sums for a block stay in registers. A
// block stores its points axis by axis. Unused places in the last block are zero.
constexpr Index kBlock = 16;

// Computes the distances from point i to all points before it. The last block is written
// completely, even the entries after point i. @return the least squared distance that is not zero.
PH_FOR_EACH_TARGET
double distances_of_row(const double* blocks, Index dims, Index i, double* out) {
  const double* point = blocks + i / kBlock * kBlock * dims + i % kBlock;
  for (Index first = 0; first < i; first += kBlock) {
    const double* block = blocks + first * dims;
    double sums[kBlock] = {};
    for (Index k = 0; k < dims; ++k) {
      const double x = point[k * kBlock];
      for (Index j = 0; j < kBlock; ++j) {
        const double t = x - block[k * kBlock + j];
        sums[j] += t * t;
      }
    }
    for (Index j = 0; j < kBlock; ++j) out[first + j] = sums[j];
  }
  constexpr double most = std::numeric_limits<double>::max();
  double least[kBlock];
  std::fill_n(least, kBlock, most);
  Index j = 0;
  for (; j + kBlock <= i; j += kBlock) {
    for (Index b = 0; b < kBlock; ++b) {
      const double square = out[j + b], positive = square > 0 ? square : most;
      least[b] = positive < least[b] ? positive : least[b];
      out[j + b] = std::sqrt(square);
    }
  }
  for (; j < i; ++j) {
    if (out[j] > 0) least[0] = std::min(least[0], out[j]);
    out[j] = std::sqrt(out[j]);
  }
  return *std::min_element(least, least + kBlock);
}

// Read as integers, the bits of non-negative doubles are in the same order as the doubles. The bits
// of negative doubles and of NaN are larger than the bits of infinity.
PH_FOR_EACH_TARGET
std::uint64_t take_maxima_as_bits(double* row, Index count, double* of_columns) {
  std::uint64_t largest = 0;
  for (Index j = 0; j < count; ++j) {
    row[j] += 0.0;
    const auto bits = std::bit_cast<std::uint64_t>(row[j]);
    largest = bits > largest ? bits : largest;
    of_columns[j] = row[j] > of_columns[j] ? row[j] : of_columns[j];
  }
  return largest;
}

}  // namespace

double take_maxima(double* row, Index count, double* of_columns) {
  const std::uint64_t largest = take_maxima_as_bits(row, count, of_columns);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return largest <= std::bit_cast<std::uint64_t>(infinity)
             ? std::bit_cast<double>(largest)
             : std::numeric_limits<double>::quiet_NaN();
}

RowDistances<PointMetric>::RowDistances(const PointMetric& metric,
                                        std::pmr::memory_resource* memory)
    : metric_(metric), blocks_(memory) {
  const PointsView points = metric.points();
  if (!metric.is_plain_euclidean() || points.cols() == 0) return;
  blocks_.resize(static_cast<std::size_t>(row_capacity() * points.cols()));
  for (Index i = 0; i < points.rows(); ++i)
    for (Index k = 0; k < points.cols(); ++k)
      blocks_[static_cast<std::size_t>((i / kBlock * points.cols() + k) * kBlock + i % kBlock)] =
          points(i, k);
}

Index RowDistances<PointMetric>::row_capacity() const {
  return (metric_.size() + kBlock - 1) / kBlock * kBlock;
}

void RowDistances<PointMetric>::operator()(Index i, double* out) const {
  if (!blocks_.empty() && distances_of_row(blocks_.data(), metric_.points().cols(), i, out) >=
                              PointMetric::kLeastPlainSquare)
    return;
  for (Index j = 0; j < i; ++j) out[j] = metric_(i, j);
}

}  // namespace ph
