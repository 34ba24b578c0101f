// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <concepts>

#include "ph/filtration.hpp"

namespace ph {

/// Points of R^d, one a row.
using Points = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A finite set with a dissimilarity: symmetric, zero on the diagonal, never negative or NaN;
/// +infinity means that two points are never joined. The triangle inequality is not required.
/// Several threads may ask at once.
template <class M>
concept Metric = requires(const M& m, Index i, Index j) {
  { m.size() } -> std::convertible_to<Index>;
  { m(i, j) } -> std::convertible_to<double>;
};

}  // namespace ph
