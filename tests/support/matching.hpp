// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "ph/barcode.hpp"

namespace ph::test {

/// Checks that two barcodes can be matched. In each pair, the late bar must be born no earlier than
/// the early bar, and no later than latest(birth of the early bar). The same must hold for the
/// deaths. A bar of either barcode may stay unmatched only if it dies no later than latest(its
/// birth). @return what is wrong; empty if the barcodes can be matched.
/// @param latest a function that never decreases; a small tolerance is added for rounding.
inline std::string late_matching_fault(const Barcode& early, const Barcode& late, int dim,
                                       const std::function<double(double)>& latest) {
  constexpr double hair = 1e-9;
  const auto is_late = [&](double before, double after) {
    return after >= before - hair && (after <= latest(before) + hair || after == before);
  };
  const auto fits = [&](const Bar& a, const Bar& b) {
    return is_late(a.birth, b.birth) && is_late(a.death, b.death);
  };
  // Two matchings are found: one covers the required early bars, and the other covers the required
  // late bars. They can be combined into one matching that covers both (Mendelsohn & Dulmage 1958).
  const auto uncovered = [&](const auto& bars, const auto& others, auto&& are_matched) {
    std::vector<int> partner(others.size(), -1);
    std::vector<bool> seen;
    const std::function<bool(int)> place = [&](int i) {
      for (std::size_t j = 0; j < others.size(); ++j) {
        if (seen[j] || !are_matched(bars[static_cast<std::size_t>(i)], others[j])) continue;
        seen[j] = true;
        if (partner[j] < 0 || place(partner[j])) {
          partner[j] = i;
          return true;
        }
      }
      return false;
    };
    for (std::size_t i = 0; i < bars.size(); ++i) {
      if (bars[i].death <= latest(bars[i].birth) + hair) continue;
      seen.assign(others.size(), false);
      if (!place(static_cast<int>(i)))
        return "H" + std::to_string(dim) + " [" + std::to_string(bars[i].birth) + ", " +
               std::to_string(bars[i].death) + ")";
    }
    return std::string();
  };
  const auto before = early.bars(dim), after = late.bars(dim);
  if (const auto bar = uncovered(before, after, fits); !bar.empty())
    return bar + " has no partner among the late bars";
  const auto fits_backwards = [&](const Bar& b, const Bar& a) { return fits(a, b); };
  if (const auto bar = uncovered(after, before, fits_backwards); !bar.empty())
    return bar + " has no partner among the early bars";
  return "";
}

}  // namespace ph::test
