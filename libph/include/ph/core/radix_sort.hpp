// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <utility>
#include <vector>

namespace ph {

/// Sorts by a double, ascending; equal values keep their order. Values are not NaN, and zero has
/// one sign. Least significant digit first, 11 bits a pass; digits that all values share cost
/// nothing, so that bytes, integers and float32 are sorted in two or three passes. O(n), n items of
/// buffer.
/// @param value_of maps an item to its value.
template <class T, class ValueOf>
void radix_sort_by_value(std::pmr::vector<T>& items, ValueOf&& value_of) {
  // Below this the histograms cost more than comparisons.
  constexpr std::size_t few = 1024;
  if (items.size() < few) {
    std::stable_sort(items.begin(), items.end(),
                     [&](const T& a, const T& b) { return value_of(a) < value_of(b); });
    return;
  }
  constexpr int digit_bits = 11, passes = 6;
  constexpr std::uint64_t mask = (1U << digit_bits) - 1;
  // IEEE doubles order like integers of their bits once negative ones are turned around.
  const auto key_of = [&](const T& item) {
    const auto bits = std::bit_cast<std::uint64_t>(static_cast<double>(value_of(item)));
    return bits >> 63 ? ~bits : bits | std::uint64_t{1} << 63;
  };
  std::array<std::array<std::size_t, mask + 1>, passes> counts{};
  for (const T& item : items) {
    const std::uint64_t key = key_of(item);
    for (std::size_t p = 0; p < passes; ++p) ++counts[p][key >> (p * digit_bits) & mask];
  }
  std::pmr::vector<T> buffer(items.size(), items.get_allocator());
  const std::uint64_t any = key_of(items.front());
  for (std::size_t p = 0; p < passes; ++p) {
    auto& next = counts[p];
    if (next[any >> (p * digit_bits) & mask] == items.size()) continue;
    std::size_t sum = 0;
    for (std::size_t& count : next) sum += std::exchange(count, sum);
    for (const T& item : items) buffer[next[key_of(item) >> (p * digit_bits) & mask]++] = item;
    items.swap(buffer);
  }
}

}  // namespace ph
