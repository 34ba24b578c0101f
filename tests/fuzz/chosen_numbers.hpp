// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>
#include <vector>

#include "ph/points.hpp"

namespace ph::fuzz {

/// Makes choices from bytes. The chosen numbers may be arbitrary doubles, close to one another, on
/// or near a grid, or orders of magnitude apart.
class ChosenNumbers {
 public:
  explicit ChosenNumbers(std::string_view bytes) : left_(bytes) {}

  /// A number from 0 to `most`.
  int choice(int most) { return byte() % (most + 1); }
  bool coin() { return choice(1) == 1; }
  unsigned char byte() {
    if (left_.empty()) return 0;
    const auto first = static_cast<unsigned char>(left_.front());
    left_.remove_prefix(1);
    return first;
  }
  double number() {
    const unsigned char kind = byte();
    double x = 0;
    switch (kind % 8) {
      case 0: {
        std::int64_t bits = 0;
        for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
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
        x = before_.empty() ? 0 : before_[byte() % before_.size()];
        break;
      case 5:
        x = moved(before_.empty() ? 1 : before_[byte() % before_.size()], signed_byte());
        break;
      default:
        x = signed_byte() % 5;
        break;
    }
    before_.push_back(x);
    return x;
  }
  std::vector<double> numbers(Index count) {
    std::vector<double> all(static_cast<std::size_t>(count));
    for (double& x : all) x = number();
    return all;
  }
  Points points(Index count, Index coordinates) {
    Points points(count, coordinates);
    for (double& x : points.coordinates()) x = number();
    return points;
  }

 private:
  int signed_byte() { return static_cast<signed char>(byte()); }
  /// The double whose bits, as an integer, are the bits of x plus `places`. For negative x, it lies
  /// before x if `places` is positive. Returns x if the result is not finite.
  static double moved(double x, int places) {
    const double result =
        std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) + static_cast<std::uint64_t>(places));
    return std::isfinite(result) ? result : x;
  }

  std::string_view left_;
  std::vector<double> before_;
};

}  // namespace ph::fuzz
