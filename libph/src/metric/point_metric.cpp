// SPDX-License-Identifier: MIT
#include "ph/points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ph/error.hpp"

namespace ph {
namespace {

// Differences of coordinates whose squares neither overflow nor lose their digits to underflow.
constexpr double kLargestPlain = 1e150;
constexpr double kSmallestPlain = 1e-140;
static_assert(PointMetric::kLeastPlainSquare >= kSmallestPlain * kSmallestPlain);

}  // namespace

PointMetric::PointMetric(const Points& points, PointDistance distance, double p)
    : points_(points), distance_(distance), p_(p) {
  if (distance == PointDistance::minkowski && !(p >= 1)) {
    throw Error(ErrorKind::usage, fmt::format("Minkowski exponent: found {}, expected >= 1", p));
  }
  double largest = 0;
  for (Index i = 0; i < points.rows(); ++i) {
    for (Index k = 0; k < points.cols(); ++k) {
      if (!std::isfinite(points(i, k))) {
        throw Error(ErrorKind::bad_data,
                    fmt::format("point {}, coordinate {}: found {}, expected a finite number", i, k,
                                points(i, k)));
      }
      largest = std::max(largest, std::abs(points(i, k)));
    }
    if (distance == PointDistance::cosine && points.row(i).isZero(0)) {
      throw Error(ErrorKind::bad_data,
                  fmt::format("point {}: found the zero vector, which has no direction; the cosine "
                              "distance needs one",
                              i));
    }
  }
  may_need_scaling_ = largest > kLargestPlain || (largest > 0 && largest < kSmallestPlain);
}

double PointMetric::euclidean(Index i, Index j) const {
  const double* x = points_.row(i).data();
  const double* y = points_.row(j).data();
  const Index d = points_.cols();
  if (!may_need_scaling_) {
    double sum = 0;
    for (Index k = 0; k < d; ++k) sum += (x[k] - y[k]) * (x[k] - y[k]);
    // A tiny sum may have lost digits to underflow: take the careful way for it.
    if (sum >= kLeastPlainSquare || sum == 0) return std::sqrt(sum);
  }
  // Halves only where whole differences overflow: the half of the least denormal is zero.
  const auto scaled = [&](double unit) {
    double largest = 0;
    for (Index k = 0; k < d; ++k) largest = std::max(largest, std::abs(x[k] * unit - y[k] * unit));
    if (largest == 0 || std::isinf(largest)) return largest;
    double sum = 0;
    for (Index k = 0; k < d; ++k) {
      const double t = (x[k] * unit - y[k] * unit) / largest;
      sum += t * t;
    }
    return largest * std::sqrt(sum) / unit;
  };
  const double plain = scaled(1);
  return std::isinf(plain) ? scaled(0.5) : plain;
}

double PointMetric::operator()(Index i, Index j) const {
  if (i == j) return 0;
  const double d = distance_ == PointDistance::euclidean ? euclidean(i, j) : other(i, j);
  // Taken for an infinite distance, it would pass for "never joined".
  if (!(d <= std::numeric_limits<double>::max())) {
    throw Error(ErrorKind::bad_data,
                fmt::format("two points are farther apart than the largest double, {}; scale the "
                            "coordinates down",
                            std::numeric_limits<double>::max()));
  }
  return d;
}

double PointMetric::other(Index i, Index j) const {
  const auto x = points_.row(i), y = points_.row(j);
  switch (distance_) {
    case PointDistance::manhattan:
      return (x - y).lpNorm<1>();
    case PointDistance::chebyshev:
      return points_.cols() == 0 ? 0 : (x - y).lpNorm<Eigen::Infinity>();
    case PointDistance::minkowski: {
      const double largest = points_.cols() == 0 ? 0 : (x - y).cwiseAbs().maxCoeff();
      if (largest == 0) return 0;
      return largest * std::pow(((x - y).array().abs() / largest).pow(p_).sum(), 1 / p_);
    }
    case PointDistance::cosine: {
      // |x/|x| - y/|y||^2 / 2 is the same number and keeps its digits for small angles.
      return (x.stableNormalized() - y.stableNormalized()).squaredNorm() / 2;
    }
    case PointDistance::hamming:
      return static_cast<double>((x.array() != y.array()).count());
    case PointDistance::euclidean:
      break;
  }
  return 0;
}

}  // namespace ph
