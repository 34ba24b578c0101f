// SPDX-License-Identifier: MIT
#include "libph/src/alpha/periodic/box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ph/barcode.hpp"
#include "ph/error.hpp"

namespace ph::alpha {
namespace {

/// The smallest and the largest of the numbers added. Numbers that are not finite are ignored,
/// because other code reports them.
class Extent {
 public:
  void add(double x) {
    if (!std::isfinite(x)) return;
    low_ = std::min(low_, x);
    high_ = std::max(high_, x);
  }
  double size() const { return low_ < high_ ? high_ - low_ : 0; }

 private:
  double low_ = kInfinity, high_ = -kInfinity;
};

void check_periods(PointsView points, std::span<const double> period) {
  if (period.size() != static_cast<std::size_t>(points.cols()))
    throw Error(ErrorKind::usage, fmt::format("period: found {} lengths, expected one for each of "
                                              "{} axes, with 0 for an axis that is not periodic",
                                              period.size(), points.cols()));
  for (std::size_t axis = 0; axis < period.size(); ++axis)
    if (!(period[axis] >= 0) || !std::isfinite(period[axis]))
      throw Error(ErrorKind::usage,
                  fmt::format("period of axis {}: found {}, expected a finite length, or 0 if the "
                              "axis is not periodic",
                              axis, period[axis]));
}

/// Returns the power of two u for which size / u lies between 2^50 and 2^51. For tiny sizes,
/// returns the smallest positive double.
double unit_of(double size) {
  constexpr int bits = 51, least = -1074;
  return std::ldexp(1.0, std::max(std::ilogb(size) + 1 - bits, least));
}
double rounded(double x, double unit) { return std::nearbyint(x / unit) * unit; }

}  // namespace

Folded fold_points(PointsView points, std::span<const double> weights,
                   std::span<const double> period) {
  check_periods(points, period);
  const auto axes = static_cast<std::size_t>(points.cols());
  Folded folded{Points(points), {}};
  Box& box = folded.box;
  Extent of_weights;
  for (const double w : weights) of_weights.add(w);
  box.size = std::sqrt(of_weights.size());
  for (std::size_t axis = 0; axis < axes; ++axis) {
    Extent extent;
    for (Index i = 0; i < points.rows(); ++i) extent.add(points(i, static_cast<Index>(axis)));
    box.size = std::hypot(box.size, period[axis] > 0 ? period[axis] : extent.size());
  }
  if (!std::isfinite(box.size))
    throw Error(ErrorKind::bad_data,
                "alpha complex: found data whose extent exceeds the largest double");
  const double unit = unit_of(box.size);
  for (std::size_t axis = 0; axis < axes; ++axis) {
    if (period[axis] == 0) continue;
    const double length = box.period[axis] = rounded(period[axis], unit);  // mutant: alpha-period
    if (length == 0)
      throw Error(
          ErrorKind::bad_data,
          fmt::format("period of axis {}: found {:g}, which is too small beside the extent of the "
                      "data ({:g}) and would be rounded to 0; expected a larger period",
                      axis, period[axis], box.size));
    for (Index i = 0; i < points.rows(); ++i) {
      double& x = folded.points(i, static_cast<Index>(axis));
      if (!std::isfinite(x)) continue;
      x = rounded(std::fmod(x, length), unit);  // the result of std::fmod is exact
      if (x < 0) x += length;                   // mutant: alpha-fold
      if (x >= length) x -= length;
    }
  }
  return folded;
}

}  // namespace ph::alpha
