// SPDX-License-Identifier: MIT
#include <array>

namespace {

constexpr double kListed = 0.3, kNotListed = 2, kChanged = 0.7;
constexpr int kTwice = 4;
constexpr PlaneMargin kMargin{0.02, 1};

int guess(const std::array<double, 3>& place, int points) {
  constexpr int kTwice = 5;
  const double share = 0.35;  // 7 of 20
  // These numbers decide on nothing.
  const char* const text = "more than 9 points";
  return share * place[2] < kListed && points << 12 > 3 * points ? 2 * kTwice : text[0];
}

}  // namespace
