// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>

#include "libph/src/alpha/sites/power_of_two.hpp"

namespace ph::alpha {

/// The unevaluated sum of two doubles. The second double is at most half a unit in the last place
/// of the first double. The sum therefore has about 106 significant bits (Dekker, A floating-point
/// technique for extending the available precision, 1971).
class DoubleDouble {
 public:
  constexpr DoubleDouble(double high = 0) : high_(high) {}
  double high() const { return high_; }
  /// The result is exact unless it underflows.
  DoubleDouble times_power_of_two(int exponent) const {
    return {alpha::times_power_of_two(high_, exponent), alpha::times_power_of_two(low_, exponent)};
  }

  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    DoubleDouble high = sum(a.high_, b.high_);
    const DoubleDouble low = sum(a.low_, b.low_);
    high = fast_sum(high.high_, high.low_ + low.high_);
    return fast_sum(high.high_, high.low_ + low.low_);
  }
  friend DoubleDouble operator-(const DoubleDouble& a) { return {-a.high_, -a.low_}; }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const double high = a.high_ * b.high_;
    const double rest = std::fma(a.high_, b.high_, -high);
    return fast_sum(high, rest + (a.high_ * b.low_ + a.low_ * b.high_));
  }
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.high_ / b.high_;
    const DoubleDouble rest = a - b * DoubleDouble(first);
    return fast_sum(first, rest.high_ / b.high_);
  }

 private:
  constexpr DoubleDouble(double high, double low) : high_(high), low_(low) {}
  static DoubleDouble sum(double a, double b) {  // Knuth's sum is always exact
    const double s = a + b, part = s - a;
    return {s, (a - (s - part)) + (b - part)};
  }
  static DoubleDouble fast_sum(double a, double b) {  // the result is exact if |a| >= |b|
    const double s = a + b;
    return {s, b - (s - a)};
  }

  double high_, low_ = 0;
};

}  // namespace ph::alpha
