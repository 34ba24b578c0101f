// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>

#include "ph/core/run_context.hpp"

namespace ph {

/// std::sort that can be stopped: each comparison is work of the ticker.
/// @throws Error (cancelled); the elements are then in any order.
template <class Iterator, class Less>
void polled_sort(Iterator first, Iterator last, const Less& less, Ticker& ticker) {
  std::sort(first, last, [&](const auto& a, const auto& b) {
    ticker.work();
    return less(a, b);
  });
}

}  // namespace ph
