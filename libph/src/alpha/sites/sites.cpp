// SPDX-License-Identifier: MIT
#include "libph/src/alpha/sites/sites.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libph/src/alpha/sites/hilbert.hpp"
#include "libph/src/alpha/sites/power_of_two.hpp"
#include "ph/detail/core/radix_sort.hpp"
#include "ph/detail/metric/metric.hpp"
#include "ph/error.hpp"

namespace ph::alpha {
namespace {

struct Placed {
  std::uint64_t place;  // position along the curve
  std::uint32_t point;  // point of the input
};

void check_sizes(PointsView points, std::span<const double> weights) {
  if (points.rows() > 0 && (points.cols() < 1 || points.cols() > 3))
    throw Error(ErrorKind::usage,
                fmt::format("alpha complex: found points of R^{}, expected R^1 to R^3; a Rips "
                            "complex takes points of any dimension",
                            points.cols()));
  if (points.rows() >= Index{kNone})
    throw Error(ErrorKind::resource, fmt::format("alpha complex: found {} points, expected at most "
                                                 "{}",
                                                 points.rows(), kNone - 1));
  if (!weights.empty() && weights.size() != static_cast<std::size_t>(points.rows()))
    throw Error(ErrorKind::usage, fmt::format("weights: found {}, expected one for each of {} "
                                              "points",
                                              weights.size(), points.rows()));
}

/// The largest magnitude of a coordinate, or of the square root of a weight.
double largest_magnitude(PointsView points, std::span<const double> weights) {
  double largest = 0;
  for (Index i = 0; i < points.rows(); ++i)
    for (Index k = 0; k < points.cols(); ++k) {
      if (!std::isfinite(points(i, k))) throw not_finite(i, k, points(i, k));
      largest = std::max(largest, std::abs(points(i, k)));
    }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!std::isfinite(weights[i]))
      throw Error(ErrorKind::bad_data,
                  fmt::format("weight of point {}: found {}, expected a finite "
                              "number",
                              i, weights[i]));
    largest = std::max(largest, std::sqrt(std::abs(weights[i])));
  }
  return largest;
}

/// Multiplies by 2^-exponent. @throws Error (bad_data) unless the result is exact.
double scaled(double x, int exponent, Index point) {
  const double result = times_power_of_two(x, -exponent) + 0.0;  // the sum turns -0 into 0
  if (times_power_of_two(result, exponent) != x)                 // mutant: alpha-bits-lost
    throw Error(ErrorKind::bad_data,
                fmt::format("point {}: found {:g} in data with numbers as large as 2^{}, expected "
                            "numbers whose magnitudes differ less",
                            point, x, exponent));
  return result;
}

/// Computes the positions of points along a Hilbert curve that fills the smallest cube around them.
template <std::size_t N>
void place_along_curve(std::span<const Vector<double>> points, std::span<Placed> order,
                       Ticker& ticker) {
  constexpr int bits = N == 2 ? 31 : 21;
  Vector<double> low = points.front(), high = low;
  for (const auto& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vector<double> size = high - low;
  const double side = std::max({size.x, size.y, size.z});
  constexpr double cells = static_cast<double>((std::uint32_t{1} << bits) - 1);
  // The quotient overflows if the cube is very small compared with the weights.
  const double scale = side > 0 ? std::min(cells / side, std::numeric_limits<double>::max()) : 0;
  const auto cell = [&](double x) {
    return static_cast<std::uint32_t>(std::clamp(x * scale, 0.0, cells));
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    ticker.tick();
    const Vector<double> p = points[i] - low;
    if constexpr (N == 2)
      order[i] = {hilbert_place<2>({cell(p.x), cell(p.y)}, bits), static_cast<std::uint32_t>(i)};
    else
      order[i] = {hilbert_place<3>({cell(p.x), cell(p.y), cell(p.z)}, bits),
                  static_cast<std::uint32_t>(i)};
  }
}

/// Sorts points by position along the curve; points whose positions agree in the first 53 bits may
/// come in any order.
std::pmr::vector<Placed> along_curve(std::span<const Vector<double>> points, int coordinates,
                                     Ticker& ticker, const RunContext& context) {
  std::pmr::vector<Placed> order(points.size(), &context.memory);
  if (coordinates == 3)
    place_along_curve<3>(points, order, ticker);
  else
    place_along_curve<2>(points, order, ticker);
  radix_sort_by_value(
      order, [](const Placed& p) { return static_cast<double>(p.place >> 11); }, context);
  return order;
}

}  // namespace

Sites sites_of(PointsView points, std::span<const double> weights, const RunContext& context,
               double largest) {
  check_sizes(points, weights);
  std::pmr::memory_resource* const memory = &context.memory;
  Sites sites(memory);
  sites.coordinates = static_cast<int>(points.cols());
  const auto count = static_cast<std::size_t>(points.rows());
  if (count == 0) return sites;
  largest = std::max(largest, largest_magnitude(points, weights));
  if (largest > 0) sites.exponent = std::ilogb(largest) + 1;

  RawVector<Vector<double>> scaled_points(count, memory);
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<Index>(i);
    const auto at = [&](Index k) {
      return k < points.cols() ? scaled(points(row, k), sites.exponent, row) : 0.0;
    };
    scaled_points[i] = {at(0), at(1), at(2)};
  }
  const auto weight_of = [&](std::uint32_t i) {
    return weights.empty() ? 0.0 : scaled(weights[i], 2 * sites.exponent, Index{i});
  };

  Ticker ticker(context, "spatial order", count);
  auto order = along_curve(scaled_points, sites.coordinates, ticker, context);
  // Points in the same cell of the curve are sorted by coordinates. Copies of a point are sorted by
  // weight, then by number.
  const auto precedes = [&](const Placed& a, const Placed& b) {
    if (a.place != b.place) return a.place < b.place;
    const Vector<double>&p = scaled_points[a.point], &q = scaled_points[b.point];
    if (p != q) return lexicographically_before(p, q);  // mutant: alpha-curve-tie
    const double v = weight_of(a.point), w = weight_of(b.point);
    return v != w ? v > w : a.point < b.point;  // mutant: alpha-lightest
  };
  for (std::size_t begin = 0, end; begin < count; begin = end) {
    const std::uint64_t place = order[begin].place >> 11;
    for (end = begin + 1; end < count && order[end].place >> 11 == place;) ++end;
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin),
              order.begin() + static_cast<std::ptrdiff_t>(end), precedes);
    ticker.work();
  }

  sites.points.reserve(count);
  sites.input.reserve(count);
  if (!weights.empty()) sites.weights.reserve(count);
  for (const Placed& placed : order) {
    const Vector<double>& p = scaled_points[placed.point];
    if (!sites.points.empty() && sites.points.back() == p) {  // mutant: alpha-copies
      sites.copies.push_back({placed.point, static_cast<std::uint32_t>(sites.size() - 1)});
      continue;
    }
    sites.points.push_back(p);
    sites.input.push_back(placed.point);
    if (!weights.empty()) sites.weights.push_back(weight_of(placed.point));
  }
  return sites;
}

void order_path(Sites& sites, const RunContext& context) {
  Ticker ticker(context, "spatial order", sites.size());
  sites.path.clear();
  sites.path.reserve(sites.size());
  for (const Placed& placed : along_curve(sites.points, sites.coordinates, ticker, context))
    sites.path.push_back(placed.point);
}

}  // namespace ph::alpha
