// SPDX-License-Identifier: MIT
#include "libsegment/src/surface/noise.hpp"

#include <algorithm>
#include <cmath>

namespace ph::segment {

ConcavityNoise::ConcavityNoise(const std::vector<double>& ranges,
                               const std::vector<double>& values) {
  // The number of points needed for a reliable quantile.
  // mutant: noise-fewest
  constexpr std::size_t fewest = 300;
  // mutant: noise-quantile
  constexpr double quantile = 0.84;  // one standard deviation up in a normal distribution
  constexpr std::size_t most = 8;    // the largest number of ranges
  std::vector<NoiseAt> of;
  for (std::size_t i = 0; i < ranges.size(); ++i) of.push_back({ranges[i], values[i]});
  std::ranges::sort(of, [](const NoiseAt& a, const NoiseAt& b) {
    // mutant: noise-equal-ranges
    return std::pair(a.range, a.concavity) < std::pair(b.range, b.concavity);
  });
  const std::size_t count = std::min(most, of.size() / fewest);
  for (std::size_t b = 0; b < count; ++b) {
    const auto begin = of.begin() + static_cast<std::ptrdiff_t>(b * of.size() / count);
    const auto end = of.begin() + static_cast<std::ptrdiff_t>((b + 1) * of.size() / count);
    const double range = (begin + (end - begin) / 2)->range;
    const auto at =
        begin + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(end - begin));
    std::ranges::nth_element(begin, at, end, {}, &NoiseAt::concavity);
    measured_.push_back({range, at->concavity});
  }
}

double ConcavityNoise::at(double range) const {
  constexpr double least = 1e-3;
  constexpr NoiseAt typical{1, 0.03};
  // Outside the measured ranges, the noise changes like the noise of depth.
  const auto scaled = [&](const NoiseAt& from) {
    return from.concavity * (range / from.range) * (range / from.range);  // mutant: noise-range
  };
  double noise = 0;
  const auto next = std::ranges::lower_bound(measured_, range, {}, &NoiseAt::range);
  if (measured_.empty()) {
    noise = scaled(typical);
  } else if (next == measured_.begin()) {
    noise = scaled(*next);
  } else if (next == measured_.end()) {
    noise = scaled(measured_.back());
  } else {
    const NoiseAt& before = *(next - 1);
    const double t = (range - before.range) / (next->range - before.range);
    noise = before.concavity + t * (next->concavity - before.concavity);
  }
  return std::max(noise, least);  // mutant: noise-limits
}

}  // namespace ph::segment
