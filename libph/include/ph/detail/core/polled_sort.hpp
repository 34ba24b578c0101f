// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>

#include "ph/run_context.hpp"

namespace ph {

/// Sorts a range, unless it is sorted already. The sort can be stopped, because each comparison
/// counts as work for the ticker.
/// @throws Error (cancelled); the elements are then in any order.
template <class Range, class Less>
void polled_sort(Range& range, const Less& less, Ticker& ticker) {
  const auto polled = [&](const auto& a, const auto& b) {
    ticker.work();
    return less(a, b);
  };
  if (!std::ranges::is_sorted(range, polled)) std::ranges::sort(range, polled);
}

}  // namespace ph
