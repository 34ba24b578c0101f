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
/// one sign. Three passes of 11 bits, the least significant first, over the 33 bits that begin with
/// the highest one in which two values differ: enough for bytes, integers and float32. What is
/// equal in them, a few neighbours as a rule, is sorted by comparison. n items of buffer.
/// @param value_of maps an item to its value.
template <class T, class ValueOf>
void radix_sort_by_value(std::pmr::vector<T>& items, ValueOf&& value_of) {
  // Below this the histograms cost more than comparisons.
  constexpr std::size_t few = 1024;
  const auto precedes = [&](const T& a, const T& b) { return value_of(a) < value_of(b); };
  if (items.size() < few) {
    std::stable_sort(items.begin(), items.end(), precedes);
    return;
  }
  constexpr int digit_bits = 11, passes = 3;
  constexpr std::uint64_t mask = (1U << digit_bits) - 1;
  // IEEE doubles order like integers of their bits once negative ones are turned around.
  const auto key_of = [&](const T& item) {
    const auto bits = std::bit_cast<std::uint64_t>(static_cast<double>(value_of(item)));
    return bits >> 63 ? ~bits : bits | std::uint64_t{1} << 63;
  };
  const std::uint64_t any = key_of(items.front());
  std::uint64_t differing = 0;
  for (const T& item : items) differing |= key_of(item) ^ any;
  const int shift = std::max(0, static_cast<int>(std::bit_width(differing)) - passes * digit_bits);
  std::array<std::array<std::size_t, mask + 1>, passes> counts{};
  for (const T& item : items) {
    const std::uint64_t key = key_of(item) >> shift;
    for (std::size_t p = 0; p < passes; ++p) ++counts[p][key >> (p * digit_bits) & mask];
  }
  std::pmr::vector<T> buffer(items.size(), items.get_allocator());
  for (std::size_t p = 0; p < passes; ++p) {
    auto& next = counts[p];
    if (next[any >> shift >> (p * digit_bits) & mask] == items.size()) continue;
    std::size_t sum = 0;
    for (std::size_t& count : next) sum += std::exchange(count, sum);
    for (const T& item : items)
      buffer[next[key_of(item) >> shift >> (p * digit_bits) & mask]++] = item;
    items.swap(buffer);
  }
  if ((differing & ((std::uint64_t{1} << shift) - 1)) == 0) return;
  for (std::size_t begin = 0, end; begin < items.size(); begin = end) {
    const std::uint64_t key = key_of(items[begin]) >> shift;
    bool sorted = true;
    for (end = begin + 1; end < items.size() && key_of(items[end]) >> shift == key; ++end)
      sorted = sorted && !precedes(items[end], items[end - 1]);
    if (!sorted)
      std::stable_sort(items.begin() + static_cast<std::ptrdiff_t>(begin),
                       items.begin() + static_cast<std::ptrdiff_t>(end), precedes);
  }
}

}  // namespace ph
