// SPDX-License-Identifier: MIT
#include "ph/detail/rips/key_block.hpp"

#include <algorithm>

#include "libph/src/core/for_each_target.hpp"

namespace ph {
namespace {

using Key = KeyBlock::Key;

PH_FOR_EACH_TARGET
std::uint64_t fill(std::span<const Key* const> rows, std::size_t begin, std::size_t size, Key key,
                   Key first, Key last, Key* keys) {
  // The loop processes two rows at a time, so that keys are read and written only half as often. A
  // row may be used twice.
  const Key *first_row = rows.front() + begin, *last_row = rows.back() + begin;
  for (std::size_t i = 0; i < size; ++i)
    keys[i] = std::max(key, std::max(first_row[i], last_row[i]));
  for (std::size_t k = 1; k + 1 < rows.size(); k += 2) {  // mutant: cofacet-rows
    const Key *a = rows[k] + begin, *b = rows[k + 1] + begin;
    for (std::size_t i = 0; i < size; ++i) keys[i] = std::max(keys[i], std::max(a[i], b[i]));
  }
  std::uint64_t within = 0;
  for (std::size_t i = 0; i < size; ++i)
    within |= std::uint64_t{keys[i] - first <= last - first} << i;  // mutant: cofacet-range-last
  return within;
}

}  // namespace

KeyBlock::KeyBlock(std::span<const Key* const> rows, std::uint32_t begin, std::uint32_t size,
                   Key key, Key first, Key last)
    : within_(fill(rows, begin, size, key, first, last, keys_.data())) {}

}  // namespace ph
