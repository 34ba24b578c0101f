// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "libph/src/rips/beta_skeleton/point_tree.hpp"

namespace ph::beta_skeleton {

// The spindle of an edge (u, v) consists of the points p at which the segment uv subtends an angle
// of more than 150 degrees. A point p of the spindle is in the lens of the edge, and its distance
// to every point of the lens is less than |uv|. If there is such a point, the edge changes nothing.
// For the proofs of these statements and of the statements below, see
// docs/explanation/engines/beta-skeleton.md.
//
// Rounding: the lens is defined by the rounded distances, and each rounded square has a relative
// error below 1e-15. Let e = 2e-15. If (u,q) does not come after (u,v), then |uq| <= (1 + e) |uv|.
// If |pq| < (1 - e) |uv|, then (p,q) comes before (u,v), regardless of ties. Let c denote -(u -
// p).(v - p). The proof with this e needs c >= sqrt(3/4) |up| |vp| + 3 e |uv|^2. The margin below
// is 1e-12 |uv|^2. It leaves more than a hundred times 3 e |uv|^2 for the rounding errors of the
// test itself.

/// The margin, as a multiple of |uv|^2, by which a point must be inside the spindle.
inline constexpr double kSpindleMargin = 1e-12;

/// True if p is certainly in the spindle of u and v. @param square the square of |uv|.
template <int D>
bool is_in_spindle(const double* p, const double* u, const double* v, double square) {
  double dot = 0, a = 0, b = 0;
  for (int k = 0; k < D; ++k) {
    const double x = u[k] - p[k], y = v[k] - p[k];
    dot += x * y;
    a += x * x;
    b += y * y;
  }
  const double inside = -dot - kSpindleMargin * square;
  return inside > 0 && inside * inside > 0.75 * (a * b);  // mutant: beta-spindle
}

/// True if p is certainly in the spindle of all pairs of a point in one ball and a point in
/// another. By the first test in the function, |up| |vp| >= 1e-7 |uv|^2. A margin of 1e-6 in the
/// angle therefore corresponds to 5e-14 |uv|^2 in the proof. This is more than the 3 e |uv|^2 that
/// the proof needs. This margin also exceeds the rounding error of acos.
template <int D>
bool is_in_spindles(const double* p, const double* centre_u, double radius_u,
                    const double* centre_v, double radius_v, double distance) {
  const double a = std::sqrt(Squares<D>::between(p, centre_u)),
               b = std::sqrt(Squares<D>::between(p, centre_v));
  constexpr double least = 1e-6;
  if (a - radius_u < least * distance || b - radius_v < least * distance) return false;
  if (a < 1.01 * radius_u || b < 1.01 * radius_v) return false;
  double dot = 0;
  for (int k = 0; k < D; ++k) dot += (centre_u[k] - p[k]) * (centre_v[k] - p[k]);
  const double cosine = dot / (a * b);
  if (cosine > -0.86) return false;
  // mutant: beta-box-size
  const double angle =
      std::acos(std::max(-1.0, cosine)) - std::asin(radius_u / a) - std::asin(radius_v / b);
  return angle > std::numbers::pi * 5 / 6 + 1e-6;
}

}  // namespace ph::beta_skeleton
