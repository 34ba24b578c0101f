// SPDX-License-Identifier: MIT
#pragma once
// Compares bars with the bars of an oracle.
#include <gtest/gtest.h>

#include <vector>

#include "ph/barcode.hpp"
#include "tests/libph/alpha/alpha_oracle.hpp"

namespace ph::test {

inline bool is_near(double found, const Rational& exact, double absolute) {
  const auto expected = static_cast<double>(exact);
  return std::abs(found - expected) <= absolute + 1e-12 * std::abs(expected);
}

/// Removes matching bars one by one. The found bars that remain must have length 0.
inline void expect_bars(const Barcode& found, const std::vector<OracleBar>& exact,
                        double absolute) {
  std::vector<Bar> left(found.begin(), found.end());
  for (const auto& bar : exact) {
    if (bar.death && static_cast<double>(*bar.death - bar.birth) <= 4 * absolute) continue;
    const auto at = std::ranges::find_if(left, [&](const Bar& b) {
      return b.dim == bar.dim && is_near(b.birth, bar.birth, absolute) &&
             b.is_infinite() == !bar.death &&
             (!bar.death || is_near(b.death, *bar.death, absolute));
    });
    ASSERT_NE(at, left.end()) << "H" << bar.dim << " [" << static_cast<double>(bar.birth) << ", "
                              << (bar.death ? static_cast<double>(*bar.death) : kInfinity) << ")";
    left.erase(at);
  }
  for (const Bar& bar : left)
    EXPECT_LE(bar.persistence(), 8 * absolute + 1e-12 * std::abs(bar.death))
        << "H" << bar.dim << " [" << bar.birth << ", " << bar.death << ")";
}

}  // namespace ph::test
