// SPDX-License-Identifier: MIT
#include "ph/detail/core/bit_matrix.hpp"

#include "libph/src/core/for_each_target.hpp"

namespace ph::bits {

PH_FOR_EACH_TARGET
std::size_t first_common(const Word* a, const Word* b, std::size_t words) {
  // A block is one cache line. The words of a block are scanned without branches.
  constexpr std::size_t block = 8;
  std::size_t k = 0;
  for (; k + block <= words; k += block) {
    Word any = 0;
    for (std::size_t i = 0; i < block; ++i) any |= a[k + i] & b[k + i];
    if (any != 0) break;
  }
  for (; k < words; ++k)
    if (const Word common = a[k] & b[k]; common != 0)
      return k * 64 + static_cast<std::size_t>(std::countr_zero(common));
  return kNone;
}

PH_FOR_EACH_TARGET
bool any_common(const Word* a, const Word* b, std::size_t words) {
  constexpr std::size_t block = 8;
  const auto any = [&](std::size_t first, std::size_t last) {
    Word common = 0;
    for (std::size_t k = first; k < last; ++k) common |= a[k] & b[k];
    return common != 0;
  };
  if (words < block) return any(0, words);
  for (std::size_t k = 0; k + block < words; k += block)
    if (any(k, k + block)) return true;
  return any(words - block, words);  // some words may be scanned a second time
}

PH_FOR_EACH_TARGET
std::size_t first_outside(const Word* a, const Word* b, std::size_t first, std::size_t words) {
  constexpr std::size_t block = 8;
  std::size_t k = first;
  for (; k + block <= words; k += block) {
    Word any = 0;
    for (std::size_t i = 0; i < block; ++i) any |= a[k + i] & ~b[k + i];
    if (any != 0) break;
  }
  while (k < words && (a[k] & ~b[k]) == 0) ++k;
  return k;
}

PH_FOR_EACH_TARGET
bool intersect(const Word* a, const Word* b, Word* out, std::size_t words) {
  Word any = 0;
  for (std::size_t k = 0; k < words; ++k) {
    const Word common = a[k] & b[k];
    out[k] = common;
    any |= common;
  }
  return any != 0;
}

PH_FOR_EACH_TARGET
bool split(Word* from, const Word* mask, Word* moved, std::size_t first, std::size_t words) {
  Word left = 0;
  for (std::size_t k = first; k < words; ++k) {
    const Word taken = from[k] & mask[k];
    moved[k] |= taken;
    from[k] ^= taken;
    left |= from[k];
  }
  return left != 0;
}

std::size_t first_missing(const Word* set, const Word* row, std::size_t except, std::size_t words) {
  for (std::size_t k = 0; k < words; ++k) {
    Word missing = set[k] & ~row[k];
    if (missing != 0 && k == except / 64) missing &= ~(Word{1} << (except % 64));
    if (missing != 0) return k * 64 + static_cast<std::size_t>(std::countr_zero(missing));
  }
  return kNone;
}

PH_FOR_EACH_TARGET
std::size_t count_common(const Word* a, const Word* b, std::size_t words) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < words; ++k)
    count += static_cast<std::size_t>(std::popcount(a[k] & b[k]));
  return count;
}

PH_FOR_EACH_TARGET
void add(Word* row, const Word* other, std::size_t words) {
  for (std::size_t k = 0; k < words; ++k) row[k] ^= other[k];
}

PH_FOR_EACH_TARGET
bool difference(Word* out, const Word* a, const Word* b, Word constant, const Word* mask,
                std::size_t words) {
  Word any = 0;
  for (std::size_t k = 0; k < words; ++k) {
    const Word differs = (a[k] ^ b[k] ^ constant) & mask[k];
    out[k] = (out[k] & ~mask[k]) | differs;
    any |= differs;
  }
  return any != 0;
}

}  // namespace ph::bits
