// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace ph {

/// Rows of bits, 64 to a word; the bits beyond the last column stay zero.
class BitMatrix {
 public:
  using Word = std::uint64_t;

  BitMatrix(std::size_t rows, std::size_t columns, std::pmr::memory_resource* memory)
      : words_((columns + 63) / 64), bits_(rows * words_, Word{0}, memory) {}

  std::size_t rows() const { return words_ == 0 ? 0 : bits_.size() / words_; }
  std::size_t words() const { return words_; }
  const Word* row(std::size_t i) const { return bits_.data() + i * words_; }
  bool test(std::size_t i, std::size_t j) const { return row(i)[j / 64] >> (j % 64) & 1; }
  void set(std::size_t i, std::size_t j) { bits_[i * words_ + j / 64] |= Word{1} << (j % 64); }
  void clear(std::size_t i, std::size_t j) { bits_[i * words_ + j / 64] &= ~(Word{1} << (j % 64)); }

 private:
  std::size_t words_;
  std::pmr::vector<Word> bits_;
};

/// The inner loops of Engine::edge_links, which work on rows of bits. They are compiled for several
/// instruction sets, of which the best is chosen at run time.
namespace bits {

using Word = BitMatrix::Word;
inline constexpr std::size_t kNone = SIZE_MAX;

/// The first bit that `a` and `b` share, or kNone.
std::size_t first_common(const Word* a, const Word* b, std::size_t words);

/// True if `a` and `b` share a bit.
bool any_common(const Word* a, const Word* b, std::size_t words);

/// The first word, from `first` on, in which `a` has a bit that `b` lacks, or `words` if there is
/// none.
std::size_t first_outside(const Word* a, const Word* b, std::size_t first, std::size_t words);

/// out = a & b. @return true if the result is not empty.
bool intersect(const Word* a, const Word* b, Word* out, std::size_t words);

/// In the words from `first` on, moves each bit of `from` that is also in `mask` to `moved`.
/// @return true if a bit is left in these words of `from`.
bool split(Word* from, const Word* mask, Word* moved, std::size_t first, std::size_t words);

/// The first bit of `set`, other than `except`, that `row` lacks, or kNone.
std::size_t first_missing(const Word* set, const Word* row, std::size_t except, std::size_t words);

std::size_t count_common(const Word* a, const Word* b, std::size_t words);

/// row ^= other.
void add(Word* row, const Word* other, std::size_t words);

/// Sets the bits of `out` that are in the mask to a ^ b ^ constant, and leaves all others
/// unchanged. @return true if any of the new bits is 1.
bool difference(Word* out, const Word* a, const Word* b, Word constant, const Word* mask,
                std::size_t words);

/// Calls `visit(bit)` for each bit that is set, ascending.
template <class Visit>
void for_each(const Word* row, std::size_t first, std::size_t words, Visit&& visit) {
  for (std::size_t k = first; k < words; ++k)
    for (Word rest = row[k]; rest != 0; rest &= rest - 1)
      visit(k * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
}

}  // namespace bits

}  // namespace ph
