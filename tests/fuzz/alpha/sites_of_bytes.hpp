// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>
#include <vector>

#include "ph/points.hpp"

namespace ph::fuzz {

/// Points with weights, or none, that bytes choose: any doubles, and such as lie near one another,
/// near a grid or on it, or orders of magnitude apart.
class SitesOfBytes {
 public:
  explicit SitesOfBytes(std::string_view bytes) : left_(bytes) {}

  /// From 0 to `most`.
  int choice(int most) { return next() % (most + 1); }
  Points points(Index count, Index coordinates) {
    Points points(count, coordinates);
    for (double& x : points.coordinates()) x = number();
    return points;
  }
  std::vector<double> weights(Index count) {
    std::vector<double> weights;
    for (Index i = 0; i < count; ++i) weights.push_back(number());
    return weights;
  }

 private:
  unsigned char next() {
    if (left_.empty()) return 0;
    const auto byte = static_cast<unsigned char>(left_.front());
    left_.remove_prefix(1);
    return byte;
  }
  int signed_byte() { return static_cast<signed char>(next()); }
  /// The double so many places further.
  static double moved(double x, int places) {
    const double result =
        std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) + static_cast<std::uint64_t>(places));
    return std::isfinite(result) ? result : x;
  }
  double number() {
    const unsigned char kind = next();
    double x = 0;
    switch (kind % 8) {
      case 0: {
        std::int64_t bits = 0;
        for (int i = 0; i < 8; ++i) bits = bits << 8 | next();
        x = std::bit_cast<double>(bits);
        break;
      }
      case 1:
        x = signed_byte() % 5 * 0.1;
        break;
      case 2:
        x = moved(signed_byte() % 5, signed_byte());
        break;
      case 3:
        x = std::ldexp(signed_byte(), 4 * signed_byte());
        break;
      case 4:
        x = before_.empty() ? 0 : before_[next() % before_.size()];
        break;
      case 5:
        x = moved(before_.empty() ? 1 : before_[next() % before_.size()], signed_byte());
        break;
      default:
        x = signed_byte() % 5;
        break;
    }
    before_.push_back(x);
    return x;
  }

  std::string_view left_;
  std::vector<double> before_;
};

}  // namespace ph::fuzz
