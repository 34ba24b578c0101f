// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>

namespace ph::vectors {

/// A sum with about twice as many digits as a double. Numbers that are added and later subtracted
/// leave hardly any rounding error. Source: Knuth, The art of computer programming, volume 2 (the
/// error of a sum).
class LongSum {
 public:
  void add(double x) {
    const double sum = high_ + x, back = sum - high_;
    low_ += (high_ - (sum - back)) + (x - back);  // mutant: long-sum
    high_ = sum;
  }
  void add(const LongSum& other) {
    add(other.high_);
    low_ += other.low_;
  }
  double value() const { return high_ + low_; }

 private:
  double high_ = 0, low_ = 0;
};

}  // namespace ph::vectors
