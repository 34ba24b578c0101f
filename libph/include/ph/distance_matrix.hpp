// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "ph/detail/metric/metric.hpp"

namespace ph {

/// All distances of a finite set, stored once per pair: the strict lower triangle row by row,
/// d(1,0), d(2,0), d(2,1), d(3,0), … Points may have births, the values at which they enter; some
/// matrix files store them on the diagonal. A matrix never changes, and its copies share the
/// numbers.
class DistanceMatrix {
 public:
  /// @param size number of points. @param lower size*(size-1)/2 distances, each >= 0 or +infinity.
  /// @param births one per point, finite and >= 0, or none.
  /// @throws Error (bad_data) on a wrong count, a NaN or a negative distance. The births are not
  /// checked here, but by the code that uses them.
  DistanceMatrix(Index size, std::vector<double> lower, std::vector<double> births = {});

  Index size() const { return size_; }
  /// One birth per point; if empty, all points enter at 0.
  std::span<const double> births() const { return numbers_->births; }
  double operator()(Index i, Index j) const {
    if (i == j) return 0.0;
    if (i < j) std::swap(i, j);
    return lower_[i * (i - 1) / 2 + j];
  }

 private:
  struct Numbers {
    std::vector<double> lower, births;
  };
  Index size_;
  std::shared_ptr<const Numbers> numbers_;
  const double* lower_;  // points into numbers_
};

}  // namespace ph
