// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "ph/core/run_context.hpp"

namespace ph {

/// Maps doubles other than NaN and -0.0 to integers of the same order: IEEE numbers are ordered as
/// their bits once negative ones are turned around.
inline std::uint64_t ordered_bits(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return bits >> 63 ? ~bits : bits | std::uint64_t{1} << 63;
}

/// Sorts by a double, ascending; equal values keep their order. Values are not NaN, and zero has
/// one sign. Three passes of 11 bits, the least significant first, over the 33 bits that begin with
/// the highest one in which two values differ: enough for bytes, 16-bit integers and float32 of one
/// magnitude. What is equal in them, a few neighbours as a rule, is sorted by comparison. n items
/// of buffer.
/// @param value_of maps an item to its value. @param context polled between passes.
/// @throws Error (cancelled); the items are then in any order.
template <class T, class Allocator, class ValueOf>
void radix_sort_by_value(std::vector<T, Allocator>& items, ValueOf&& value_of,
                         const RunContext& context = default_context()) {
  context.poll();
  // Below this the histograms cost more than comparisons.
  constexpr std::size_t few = 1024;
  const auto precedes = [&](const T& a, const T& b) { return value_of(a) < value_of(b); };
  if (items.size() < few) {
    std::stable_sort(items.begin(), items.end(), precedes);
    return;
  }
  constexpr int digit_bits = 11, passes = 3;
  constexpr std::uint64_t mask = (1U << digit_bits) - 1;
  const auto key_of = [&](const T& item) {
    return ordered_bits(static_cast<double>(value_of(item)));
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
  std::vector<T, Allocator> buffer(items.size(), items.get_allocator());
  for (std::size_t p = 0; p < passes; ++p) {
    context.poll();
    auto& next = counts[p];
    if (next[any >> shift >> (p * digit_bits) & mask] == items.size()) continue;
    std::size_t sum = 0;
    for (std::size_t& count : next) sum += std::exchange(count, sum);
    for (const T& item : items)
      buffer[next[key_of(item) >> shift >> (p * digit_bits) & mask]++] = item;
    items.swap(buffer);
  }
  context.poll();
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
