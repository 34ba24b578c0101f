// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "ph/filtration.hpp"

namespace ph {

/// How the balls grow around points that enter late: a point born at diameter b has at diameter t
/// the radius (t^p - b^p)^(1/p) / 2 (Anai, Chazal, Glisse, Ike, Inakoshi, Tinarrage, Umeda,
/// DTM-based filtrations, SoCG 2019).
enum class WeightExponent {
  one,       ///< p = 1
  two,       ///< p = 2
  infinity,  ///< p = infinity: of full size from the birth on
};

/// When the vertices of a Rips filtration enter, and its edges because of them.
class VertexWeights {
 public:
  /// All vertices enter at 0, edges at their distance.
  VertexWeights() = default;
  /// @param births by vertex: the diameter at which it enters, finite, >= 0; outlives this.
  VertexWeights(std::span<const double> births, WeightExponent exponent)
      : births_(births), exponent_(exponent) {}

  /// By vertex; empty: all enter at 0.
  std::span<const double> births() const { return births_; }

  /// The diameter at which the balls around two points meet, never before both are born. With b, c
  /// the births and d the distance, as long as a ball reaches the other point's before it is born:
  /// p = 1: d + (b + c) / 2; p = 2: sqrt(d^2 + (b + c)^2 / 4) sqrt(d^2 + (b - c)^2 / 4) / d;
  /// p = infinity: max(b, c, d). Never less than the distance.
  double edge_value(Index u, Index v, double distance) const {
    return births_.empty() ? distance
                           : meeting(births_[static_cast<std::size_t>(u)],
                                     births_[static_cast<std::size_t>(v)], distance);
  }

 private:
  double meeting(double b, double c, double distance) const;

  std::span<const double> births_;
  WeightExponent exponent_ = WeightExponent::infinity;
};

}  // namespace ph
