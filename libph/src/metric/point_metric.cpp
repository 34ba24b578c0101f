// SPDX-License-Identifier: MIT
#include "ph/detail/metric/metric.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libph/src/metric/plain_squares.hpp"
#include "ph/error.hpp"

namespace ph {

Error not_finite(Index point, Index coordinate, double found) {
  return {ErrorKind::bad_data,
          fmt::format("{}: found {}, expected a finite number",
                      mark_place(fmt::format("point {}, coordinate {}", point, coordinate)),
                      mark_found(fmt::format("{}", found)))};
}
namespace {

static_assert(PointMetric::kLeastPlainSquare >= kSmallestPlain * kSmallestPlain);

/// Adds the terms 0 … count - 1 in four partial sums, because additions to different sums need not
/// wait for each other.
template <class Term>
double sum_in_lanes(Index count, const Term& term) {
  std::array<double, 4> lanes{};
  const Index whole = count / 4 * 4;
  for (Index k = 0; k < whole; k += 4)
    for (Index l = 0; l < 4; ++l) lanes[static_cast<std::size_t>(l)] += term(k + l);
  double even = lanes[0] + lanes[2], odd = lanes[1] + lanes[3];
  Index k = whole;
  if (k + 2 <= count) {
    even += term(k);
    odd += term(k + 1);
    k += 2;
  }
  double sum = even + odd;
  if (k < count) sum += term(k);
  return sum;
}

/// The largest of the terms 0 … count - 1, or 0 if there are no terms or all terms are negative.
template <class Term>
double largest_of(Index count, const Term& term) {
  double largest = 0;
  for (Index k = 0; k < count; ++k) largest = std::max(largest, term(k));
  return largest;
}

/// The vector of length 1 in the direction of a given vector, which may have any length except 0.
class Direction {
 public:
  Direction(const double* x, Index d) : x_(x) {
    const double largest = largest_of(d, [&](Index k) { return std::abs(x[k]); });
    length_ =
        std::sqrt(sum_in_lanes(d, [&](Index k) { return (x[k] / largest) * (x[k] / largest); })) *
        largest;
  }
  double operator()(Index k) const { return x_[k] / length_; }

 private:
  const double* x_;
  double length_;
};

}  // namespace

std::string metric_name(PointDistance distance, double p) {
  return fmt::format("{}{}", name_of(distance),
                     distance == PointDistance::minkowski ? fmt::format(":{}", p) : "");
}

PointMetric::PointMetric(PointsView points, PointDistance distance, double p, double largest)
    : points_(points), distance_(distance), p_(p) {
  points = points_.view();
  const auto is_zero = [&](Index i) {
    return std::all_of(points.row(i), points.row(i) + points.cols(),
                       [](double x) { return x == 0; });
  };
  if (distance == PointDistance::minkowski && !(p >= 1)) {
    throw Error(ErrorKind::usage, fmt::format("Minkowski exponent: found {}, expected >= 1", p));
  }
  for (Index i = 0; i < points.rows(); ++i) {
    for (Index k = 0; k < points.cols(); ++k) {
      if (!std::isfinite(points(i, k))) throw not_finite(i, k, points(i, k));
      largest = std::max(largest, std::abs(points(i, k)));
    }
    if (distance == PointDistance::cosine && is_zero(i)) {
      throw Error(ErrorKind::bad_data,
                  fmt::format("point {}: found the zero vector, which has no direction; the cosine "
                              "distance needs one",
                              i));
    }
  }
  may_need_scaling_ = largest > kLargestPlain || (largest > 0 && largest < kSmallestPlain);
}

double PointMetric::euclidean(Index i, Index j) const {
  const double* x = points().row(i);
  const double* y = points().row(j);
  const Index d = points().cols();
  if (!may_need_scaling_) {
    double sum = 0;
    for (Index k = 0; k < d; ++k) sum += (x[k] - y[k]) * (x[k] - y[k]);
    // A tiny sum may have lost digits to underflow. The distance is then computed with scaling.
    if (sum >= kLeastPlainSquare || sum == 0) return std::sqrt(sum);
  }
  // Coordinates are halved only if their differences overflow, because half of the smallest
  // denormal is zero.
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
  // An infinite distance would be understood as "never joined".
  if (!(d <= std::numeric_limits<double>::max())) {
    throw Error(ErrorKind::bad_data,
                fmt::format("two points are farther apart than the largest double, {}; scale the "
                            "coordinates down",
                            std::numeric_limits<double>::max()));
  }
  return d;
}

/// The directions of some points, one per row.
class PointMetric::Directions {
 public:
  Directions(PointsView points, const RunContext& context)
      : claim_(context.memory, static_cast<std::size_t>(points.size()) * sizeof(double)),
        rows_(points.rows(), points.cols()) {
    for (Index i = 0; i < points.rows(); ++i) {
      context.poll();
      const Direction along(points.row(i), points.cols());
      for (Index k = 0; k < points.cols(); ++k) rows_(i, k) = along(k);
    }
  }
  const double* row(Index i) const { return rows_.row(i).data(); }

 private:
  MemoryClaim claim_;
  Points rows_;
};

void PointMetric::keep_directions(const RunContext& context) {
  if (distance_ == PointDistance::cosine)
    directions_ = std::make_shared<const Directions>(points(), context);
}

/// The distance also equals |x/|x| - y/|y||^2 / 2. This form keeps its digits for small angles.
double PointMetric::cosine(Index i, Index j) const {
  const Index d = points().cols();
  const auto half_of_square = [d](const auto& x, const auto& y) {
    return sum_in_lanes(d, [&](Index k) { return (x(k) - y(k)) * (x(k) - y(k)); }) / 2;
  };
  if (!directions_)
    return half_of_square(Direction(points().row(i), d), Direction(points().row(j), d));
  const double *x = directions_->row(i), *y = directions_->row(j);
  return half_of_square([x](Index k) { return x[k]; }, [y](Index k) { return y[k]; });
}

double PointMetric::other(Index i, Index j) const {
  const double* x = points().row(i);
  const double* y = points().row(j);
  const Index d = points().cols();
  const auto difference = [&](Index k) { return std::abs(x[k] - y[k]); };
  switch (distance_) {
    case PointDistance::manhattan:
      return sum_in_lanes(d, difference);
    case PointDistance::chebyshev:
      return largest_of(d, difference);
    case PointDistance::minkowski: {
      const double largest = largest_of(d, difference);
      if (largest == 0) return 0;
      double sum = 0;
      for (Index k = 0; k < d; ++k) sum += std::pow(difference(k) / largest, p_);
      return largest * std::pow(sum, 1 / p_);
    }
    case PointDistance::cosine:
      return cosine(i, j);
    case PointDistance::hamming: {
      Index count = 0;
      for (Index k = 0; k < d; ++k) count += x[k] != y[k] ? 1 : 0;
      return static_cast<double>(count);
    }
    case PointDistance::euclidean:
      break;
  }
  return 0;
}

}  // namespace ph
