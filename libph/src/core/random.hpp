// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstdint>
#include <utility>

namespace ph {

/// Random numbers that are the same with any C++ library, unlike the numbers of
/// std::*_distribution. Source: Steele, Lea, Flood, Fast splittable pseudorandom number generators,
/// 2014 (SplitMix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  // mutant: random-task
  /// Starts the sequence of one task. Each task of a seed has its own sequence, whichever thread
  /// runs the task.
  Random(std::uint64_t seed, std::uint64_t task) : state_(mixed(mixed(seed + kStep) + task)) {}

  std::uint64_t bits() { return mixed(state_ += kStep); }
  /// A number in [0, 1).
  double uniform() { return std::ldexp(static_cast<double>(bits() >> 11), -53); }
  /// An integer from 0 to `count` - 1, where `count` must be positive. All integers are equally
  /// likely, because numbers that would make some of them likelier are drawn again.
  std::uint64_t below(std::uint64_t count) {
    const std::uint64_t excess = (UINT64_MAX % count + 1) % count;
    std::uint64_t x = bits();
    while (x > UINT64_MAX - excess) x = bits();
    return x % count;
  }
  /// A number from the normal distribution with mean 0 and variance 1, by the polar method of
  /// Marsaglia and Bray (1964).
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    double x = 0, y = 0, square = 0;
    do {
      x = 2 * uniform() - 1;
      y = 2 * uniform() - 1;
      square = x * x + y * y;
    } while (square >= 1 || square == 0);
    const double scale = std::sqrt(-2 * std::log(square) / square);
    spare_ = y * scale;
    has_spare_ = true;
    return x * scale;
  }

 private:
  static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15;
  static std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
    return x ^ (x >> 31);
  }

  std::uint64_t state_;
  double spare_ = 0;
  bool has_spare_ = false;
};

/// Moves `count` randomly drawn elements to the front, without replacement (Fisher and Yates). If
/// `count` is the size of the range, the result is a random order of all elements.
template <class Range>
void draw(Range& elements, std::size_t count, Random& random) {
  for (std::size_t i = 0; i < count; ++i)
    std::swap(elements[i], elements[i + random.below(elements.size() - i)]);
}

}  // namespace ph
