// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ph/error.hpp"
#include "ph/significance.hpp"

namespace ph {
namespace {

void check(const Bar& bar) {
  if (!(bar.birth <= bar.death))
    throw Error(ErrorKind::bad_data,
                fmt::format("universal_p_values: found a bar [{}, {}), expected birth <= death",
                            bar.birth, bar.death));
  if (!(bar.birth > 0) || std::isinf(bar.birth))
    throw Error(ErrorKind::bad_data,
                fmt::format("universal_p_values: found a bar born at {}, expected a finite birth "
                            "above 0, because the test uses the ratio of death to birth",
                            bar.birth));
}

/// Computes log log (death / birth). The inner logarithm is computed as log(1 + x), which is also
/// accurate for small x.
double loglog(const Bar& bar) {
  const double growth = (bar.death - bar.birth) / bar.birth;
  return std::log(std::isinf(growth) ? std::log(bar.death) - std::log(bar.birth)
                                     : std::log1p(growth));
}

}  // namespace

BarPValues universal_p_values(std::span<const Bar> bars, DistanceFiltration filtration) {
  BarPValues result;
  double sum = 0;
  for (const Bar& bar : bars) {
    check(bar);
    const bool has_ratio = !bar.is_infinite() && bar.birth < bar.death;
    result.p.push_back(bar.is_infinite() ? std::numeric_limits<double>::quiet_NaN()
                       : has_ratio       ? loglog(bar)
                                         : 1.0);
    if (!has_ratio) continue;
    sum += result.p.back();
    ++result.tested;
  }
  const double a = filtration == DistanceFiltration::rips ? 1 : 0.5;  // mutant: null-cech
  const double mean = sum / static_cast<double>(std::max<std::size_t>(result.tested, 1));
  for (std::size_t i = 0; i < bars.size(); ++i)
    // The p-value is 1 - F for the left-skewed Gumbel law, F(x) = 1 - exp(-exp x), whose mean is
    // -egamma.
    if (!bars[i].is_infinite() && bars[i].birth < bars[i].death)
      // mutant: null-mean
      result.p[i] = std::exp(-std::exp(a * (result.p[i] - mean) - std::numbers::egamma));
  const auto tests = static_cast<double>(result.tested);
  for (const double p : result.p)
    result.corrected.push_back(std::isnan(p) ? p : std::min(1.0, p * std::max(tests, 1.0)));
  return result;
}

}  // namespace ph
