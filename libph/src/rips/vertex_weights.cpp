// SPDX-License-Identifier: MIT
#include "ph/detail/rips/vertex_weights.hpp"

#include <fmt/format.h>

#include "ph/error.hpp"

namespace ph {

double VertexWeights::meeting(double b, double c, double distance) const {
  const double born = std::max(b, c);
  if (std::isinf(distance)) return distance;
  double value = std::max(born, distance);  // mutant: weights-born
  switch (exponent_) {
    case WeightExponent::one:
      value = std::max(born, distance + (b / 2 + c / 2));  // mutant: weights-ball
      break;
    case WeightExponent::two:
      // If 4 d^2 < |b^2 - c^2|, the younger point is born inside the ball of the older one.
      if (2 * distance > std::sqrt(std::abs(b - c)) * std::sqrt(b + c))
        value = std::max(value, std::hypot(distance, b / 2 + c / 2) *
                                    (std::hypot(distance, b / 2 - c / 2) / distance));
      else
        value = born;
      break;
    case WeightExponent::infinity:
      break;
  }
  // An infinite distance would mean that the points are never joined.
  if (value > std::numeric_limits<double>::max()) {
    throw Error(ErrorKind::bad_data,
                fmt::format("two weighted points meet beyond the largest double, {}; scale "
                            "distances and weights down",
                            std::numeric_limits<double>::max()));
  }
  return value;
}

}  // namespace ph
