// SPDX-License-Identifier: MIT
#pragma once
// Points and matrices of Eigen, copied only where necessary. libph itself does not need Eigen. An
// Eigen matrix, Map or Block of doubles converts to PointsView without this header.
#include <Eigen/Core>

#include "ph/points.hpp"

namespace ph {

/// A matrix with one point per row.
using PointMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The points as a matrix, without a copy; the points must outlive the matrix.
inline Eigen::Map<const PointMatrix> as_matrix(const Points& points) {
  return {points.data(), static_cast<Eigen::Index>(points.rows()),
          static_cast<Eigen::Index>(points.cols())};
}
inline Eigen::Map<PointMatrix> as_matrix(Points& points) {
  return {points.data(), static_cast<Eigen::Index>(points.rows()),
          static_cast<Eigen::Index>(points.cols())};
}

/// A copy of any matrix or expression.
template <class Derived>
Points to_points(const Eigen::DenseBase<Derived>& matrix) {
  Points points(matrix.rows(), matrix.cols());
  as_matrix(points) = matrix.derived().template cast<double>();
  return points;
}

}  // namespace ph
