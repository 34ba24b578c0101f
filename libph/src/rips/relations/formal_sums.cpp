// SPDX-License-Identifier: MIT
#include "libph/src/rips/relations/formal_sums.hpp"

#include <algorithm>

namespace ph {

auto FormalSums::insert(std::span<const Generator> terms) -> Sum {
  terms_.insert(terms_.end(), terms.begin(), terms.end());
  return end_sum();
}

auto FormalSums::end_sum() -> Sum {
  if (terms_.size() == ends_.back()) return 0;
  ends_.push_back(terms_.size());
  return static_cast<Sum>(count() - 1);
}

auto FormalSums::add(Sum a, Sum b) -> Sum {
  const std::size_t size = terms_.size();
  terms_.resize(size + (*this)[a].size() + (*this)[b].size());
  const auto x = (*this)[a], y = (*this)[b];
  Generator* to = terms_.data() + size;
  std::size_t i = 0, j = 0;
  while (i < x.size() && j < y.size()) {  // a branch would be unpredictable
    const Generator g = x[i], h = y[j];
    *to = std::min(g, h);
    to += g != h;
    i += g <= h;
    j += h <= g;
  }
  to = std::copy(x.begin() + static_cast<std::ptrdiff_t>(i), x.end(), to);
  to = std::copy(y.begin() + static_cast<std::ptrdiff_t>(j), y.end(), to);
  terms_.resize(static_cast<std::size_t>(to - terms_.data()));
  return end_sum();
}

}  // namespace ph
