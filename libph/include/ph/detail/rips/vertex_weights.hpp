// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "ph/detail/core/names.hpp"
#include "ph/filtration.hpp"

namespace ph {

/// The growth of balls around points that enter late: a point born at diameter b has the radius
/// (t^p - b^p)^(1/p) / 2 at diameter t (Anai, Chazal, Glisse, Ike, Inakoshi, Tinarrage, Umeda,
/// DTM-based filtrations, SoCG 2019).
enum class WeightExponent {
  one,       ///< p = 1
  two,       ///< p = 2
  infinity,  ///< p = infinity: full size from the birth on
};

template <>
inline constexpr std::array names_of<WeightExponent>{
    Named{WeightExponent::one, "1"},
    Named{WeightExponent::two, "2"},
    Named{WeightExponent::infinity, "inf"},
};

/// The values at which the vertices of a Rips filtration enter, and their effect on its edges.
class VertexWeights {
 public:
  /// All vertices enter at 0, and edges enter at their distance.
  VertexWeights() = default;
  /// @param births by vertex: the diameter at which it enters, finite, >= 0; the span must outlive
  /// this object.
  VertexWeights(std::span<const double> births, WeightExponent exponent)
      : births_(births), exponent_(exponent) {}

  /// One birth per vertex; if empty, all vertices enter at 0.
  std::span<const double> births() const { return births_; }
  WeightExponent exponent() const { return exponent_; }

  /// The diameter at which the balls around two points meet, which is never before both are born.
  /// Let b and c be the births and d the distance. As long as no ball reaches the other point
  /// before that point is born, the diameter is d + (b + c) / 2 for p = 1, sqrt(d^2 + (b + c)^2 /
  /// 4) sqrt(d^2 + (b - c)^2 / 4) / d for p = 2, and max(b, c, d) for p = infinity. It is never
  /// less than the distance.
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
