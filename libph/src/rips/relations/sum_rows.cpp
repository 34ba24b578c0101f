// SPDX-License-Identifier: MIT
#include "libph/src/rips/relations/sum_rows.hpp"

#include <algorithm>

namespace ph {

auto SumRows::append() -> Word* {
  rows_.resize(rows_.size() + words_, 0);
  return rows_.data() + rows_.size() - words_;
}

auto SumRows::append_generator() -> Sum {
  const std::size_t g = generators_++;
  if (g == 64 * words_) widen();
  append()[g / 64] = Word{1} << (g % 64);
  return static_cast<Sum>(count() - 1);
}

auto SumRows::add(Sum a, Sum b) -> Sum {
  Word* const to = append();
  const Word *x = (*this)[a], *y = (*this)[b];
  Word any = 0;
  for (std::size_t k = 0; k < words_; ++k) any |= to[k] = x[k] ^ y[k];
  if (any == 0) rows_.resize(rows_.size() - words_);
  return any == 0 ? 0 : static_cast<Sum>(count() - 1);
}

bool SumRows::add_relation(std::span<const Sum, 4> sums) {
  const std::size_t size = values_.size();
  values_.resize(size + words_);
  const Word *a = (*this)[sums[0]], *b = (*this)[sums[1]], *c = (*this)[sums[2]],
             *d = (*this)[sums[3]];
  Word* const to = values_.data() + size;
  Word any = 0;
  for (std::size_t k = 0; k < words_; ++k) any |= to[k] = a[k] ^ b[k] ^ c[k] ^ d[k];
  if (any == 0) values_.resize(size);
  return any != 0;
}

auto SumRows::solve() -> std::span<const Generator> {
  const auto killed = matrix_.reduce(generators_, relation_count(), values_.data(), words_);
  values_.clear();
  return killed;
}

void SumRows::widen() {
  const std::size_t words = words_ + 1;
  for (auto* rows : {&rows_, &values_}) {
    std::pmr::vector<Word> widened(rows->size() / words_ * words, 0, rows->get_allocator());
    for (std::size_t i = 0; i * words_ < rows->size(); ++i)
      // mutant: sum-rows-grow
      std::copy_n(rows->data() + i * words_, words_, widened.data() + i * words);
    *rows = std::move(widened);
  }
  words_ = words;
}

}  // namespace ph
