// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ph/run_context.hpp"

namespace ph {

/// Maps doubles other than NaN and -0.0 to integers in the same order. The bits of IEEE numbers,
/// read as integers, have this order once all bits of negative numbers, and the sign bits of all
/// others, are inverted.
inline std::uint64_t ordered_bits(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return bits >> 63 ? ~bits : bits | std::uint64_t{1} << 63;
}

/// The number that `ordered_bits` mapped to these bits.
inline double from_ordered_bits(std::uint64_t bits) {
  return std::bit_cast<double>(bits >> 63 ? bits & ~(std::uint64_t{1} << 63) : ~bits);
}

namespace detail {

/// A stable sort, meant for a few items.
template <class T, class Precedes>
void sort_few(std::span<T> items, const Precedes& precedes) {
  constexpr std::size_t handful = 16;
  if (items.size() > handful) {
    std::stable_sort(items.begin(), items.end(), precedes);
    return;
  }
  for (std::size_t i = 1; i < items.size(); ++i) {
    const T item = items[i];
    std::size_t to = i;
    for (; to > 0 && precedes(item, items[to - 1]); --to) items[to] = items[to - 1];
    items[to] = item;
  }
}

}  // namespace detail

/// Sorts by a double, ascending; equal values keep their order. Values must not be NaN, and all
/// zeros must have the same sign. Makes two passes of 12 bits each (three passes for many items),
/// least significant bits first. The passes cover the bits downwards from the highest bit in which
/// two values differ. This is enough for bytes, 16-bit integers, and float32 numbers of one
/// magnitude. Items that are equal in these bits, usually a few neighbours, are sorted by
/// comparison.
/// @param buffer as long as items. @param value_of maps an item to its value.
/// @param context is polled between passes.
/// @return the span that holds the sorted items: `items` or `buffer`.
/// @throws Error (cancelled); the items are then in any order.
template <class T, class ValueOf>
std::span<T> radix_sort_by_value(std::span<T> items, std::span<T> buffer, ValueOf&& value_of,
                                 const RunContext& context) {
  context.poll();
  // Below this number of items, the histograms take longer than comparisons.
  constexpr std::size_t few = 1024;
  const auto precedes = [&](const T& a, const T& b) { return value_of(a) < value_of(b); };
  if (items.size() < few) {
    std::stable_sort(items.begin(), items.end(), precedes);
    return items;
  }
  constexpr int digit_bits = 12;
  constexpr std::size_t many = 1 << 22;
  const int passes = items.size() < many ? 2 : 3;
  constexpr std::uint64_t mask = (1U << digit_bits) - 1;
  const auto key_of = [&](const T& item) {
    return ordered_bits(static_cast<double>(value_of(item)));
  };
  const std::uint64_t any = key_of(items.front());
  std::uint64_t differing = 0;
  for (const T& item : items) differing |= key_of(item) ^ any;
  const int shift = std::max(0, static_cast<int>(std::bit_width(differing)) - passes * digit_bits);
  // The histograms are too large for the stack of a small thread.
  std::vector<std::array<std::size_t, mask + 1>> counts(static_cast<std::size_t>(passes));
  for (const T& item : items) {
    const std::uint64_t key = key_of(item) >> shift;
    for (int p = 0; p < passes; ++p)
      ++counts[static_cast<std::size_t>(p)][key >> (p * digit_bits) & mask];
  }
  for (int p = 0; p < passes; ++p) {
    context.poll();
    auto& next = counts[static_cast<std::size_t>(p)];
    if (next[any >> shift >> (p * digit_bits) & mask] == items.size()) continue;
    std::size_t sum = 0;
    for (std::size_t& count : next) sum += std::exchange(count, sum);
    for (const T& item : items)
      buffer[next[key_of(item) >> shift >> (p * digit_bits) & mask]++] = item;
    std::swap(items, buffer);
  }
  context.poll();
  if ((differing & ((std::uint64_t{1} << shift) - 1)) == 0) return items;
  for (std::size_t begin = 0, end; begin < items.size(); begin = end) {
    const std::uint64_t key = key_of(items[begin]) >> shift;
    for (end = begin + 1; end < items.size() && key_of(items[end]) >> shift == key;) ++end;
    detail::sort_few(items.subspan(begin, end - begin), precedes);
  }
  return items;
}

/// Sorts a vector in the same way, with a buffer of its own.
template <class T, class Allocator, class ValueOf>
void radix_sort_by_value(std::vector<T, Allocator>& items, ValueOf&& value_of,
                         const RunContext& context = default_context()) {
  std::vector<T, Allocator> buffer(items.size(), items.get_allocator());
  const std::span<T> sorted =
      radix_sort_by_value(std::span(items), std::span(buffer), value_of, context);
  if (sorted.data() != items.data()) items.swap(buffer);
}

}  // namespace ph
