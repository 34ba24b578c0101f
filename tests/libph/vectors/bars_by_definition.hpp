// SPDX-License-Identifier: MIT
#pragma once
// Computes vectors of diagrams by their definitions, value by value and in higher precision.
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "tests/support/random_bars.hpp"

namespace ph::test {

inline double tent(const Bar& bar, double t) {
  return std::max(0.0, std::min(t - bar.birth, bar.death - t));
}

/// The k-th largest tent at t, counted from 0; 0 if there are fewer tents.
inline double landscape_at(const Bars& bars, std::size_t k, double t) {
  std::vector<double> tents;
  for (const Bar& bar : bars) tents.push_back(tent(bar, t));
  std::ranges::sort(tents);
  return k < tents.size() ? tents[tents.size() - 1 - k] : 0;
}

inline double silhouette_at(const Bars& bars, double power, double t) {
  long double sum = 0, weights = 0;
  for (const Bar& bar : bars) {
    if (bar.birth == bar.death) continue;
    const long double weight =
        std::pow(static_cast<long double>(bar.death) - bar.birth, static_cast<long double>(power));
    sum += weight * static_cast<long double>(tent(bar, t));
    weights += weight;
  }
  return weights > 0 ? static_cast<double>(sum / weights) : 0;
}

/// -Σ p ln p over the bars for which `counts` returns true.
template <class Counts>
double entropy_of(const Bars& bars, Counts&& counts) {
  long double total = 0, sum = 0;
  for (const Bar& bar : bars) total += static_cast<long double>(bar.death) - bar.birth;
  for (const Bar& bar : bars) {
    const long double share = (static_cast<long double>(bar.death) - bar.birth) / total;
    if (bar.birth < bar.death && counts(bar)) sum -= share * std::log(share);
  }
  return static_cast<double>(sum);
}

/// The integral of a function over [a, b], by Simpson's rule on many pieces.
template <class F>
double integral(double a, double b, F&& f, int pieces = 200) {
  double sum = 0;
  const double width = (b - a) / pieces;
  for (int i = 0; i < pieces; ++i) {
    const double x = a + width * i;
    sum += width / 6 * (f(x) + 4 * f(x + width / 2) + f(x + width));
  }
  return sum;
}

}  // namespace ph::test
