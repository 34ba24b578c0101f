// SPDX-License-Identifier: MIT
#include "libph/src/rips/relations/relation_matrix.hpp"

#include <algorithm>
#include <bit>

#include "libph/src/core/for_each_target.hpp"

namespace ph {
namespace {

using Word = bits::Word;
using Row = RelationMatrix::Row;

struct Reduced {
  std::size_t column;  // SIZE_MAX if the row is empty
  std::size_t added;
};

// Adds rows of a matrix to `row` until no row of the matrix has the same first column as `row`.
// @param words the number of words per row, in complete cache lines. @param row_of for each column,
// the row of which it is the first column. @param added receives the rows that were added.
PH_FOR_EACH_TARGET
Reduced reduce_row(Word* row, const Word* matrix, std::size_t words, const Row* row_of,
                   Row* added) {
  constexpr std::size_t line = 8;
  std::size_t count = 0;
  for (std::size_t k = 0; k < words;) {
    if (row[k] == 0) {
      ++k;
      continue;
    }
    const std::size_t column = k * 64 + static_cast<std::size_t>(std::countr_zero(row[k]));
    const Row other = row_of[column];
    if (other == RelationMatrix::kNone) return {column, count};
    added[count++] = other;
    const Word* from = matrix + other * words;
    for (std::size_t i = k / line * line; i < words; i += line)
      for (std::size_t j = i; j < i + line; ++j) row[j] ^= from[j];
  }
  return {SIZE_MAX, count};
}

// Eight squares of 64 x 64 bits side by side.
using Squares = std::array<std::array<Word, 8>, 64>;

// Transposes each square by swapping the blocks above and below its diagonal. The blocks have 32 x
// 32 bits at first, and become smaller and smaller, down to single bits.
PH_FOR_EACH_TARGET
void transpose(Squares& squares) {
  Word mask = 0x00000000FFFFFFFF;
  for (std::size_t size = 32; size != 0; size /= 2, mask ^= mask << size)
    for (std::size_t k = 0; k < 64; k = (k + size + 1) & ~size)
      for (std::size_t j = 0; j < 8; ++j) {
        Word &above = squares[k][j], &below = squares[k + size][j];
        const Word differs = (above >> size ^ below) & mask;
        above ^= differs << size;
        below ^= differs;
      }
}

}  // namespace

auto RelationMatrix::reduce(std::size_t rows, std::size_t columns, const Word* relations,
                            std::size_t words) -> std::span<const Row> {
  living_ += rows - is_dead_.size();
  is_dead_.resize(rows, 0);
  lines_ = (columns + 511) / 512;
  cells_.assign(rows * lines_, Line());
  row_of_.assign(columns, kNone);
  if (columns == 0) return {};
  transpose(relations, words);
  const std::size_t row_words = lines_ * 8;
  for (std::size_t s = 0; s < steps_.size(); ++s)
    for (std::size_t i = steps_[s].begin; i < end_of(s); ++i)
      // mutant: relation-block
      bits::add(row_begin(steps_[s].to), row_begin(added_[i]), row_words);
  more_.resize(row_of_.size());
  for (auto row = static_cast<Row>(row_count()); row-- > 0;) {
    if (is_dead(row)) continue;
    const auto [column, added] =
        reduce_row(row_begin(row), row_begin(0), row_words, row_of_.data(), more_.data());
    if (added != 0) steps_.push_back({row, added_.size()});
    added_.insert(added_.end(), more_.begin(), more_.begin() + static_cast<std::ptrdiff_t>(added));
    if (column == SIZE_MAX) continue;
    row_of_[column] = row;
    is_dead_[row] = 1;
    --living_;
  }
  return row_of_;
}

void RelationMatrix::transpose(const Word* relations, std::size_t words) {
  const std::size_t columns = row_of_.size();
  Squares squares;
  for (std::size_t line = 0; line < lines_; ++line)
    for (std::size_t k = 0; k * 64 < row_count(); ++k) {
      for (std::size_t i = 0; i < squares.size(); ++i)
        for (std::size_t j = 0; j < squares[i].size(); ++j) {
          const std::size_t column = (line * 8 + j) * 64 + i;
          squares[i][j] = column < columns ? relations[column * words + k] : 0;
        }
      ph::transpose(squares);
      const std::size_t rows = std::min<std::size_t>(64, row_count() - k * 64);
      for (std::size_t i = 0; i < rows; ++i)
        cells_[(k * 64 + i) * lines_ + line].words = squares[i];
    }
}

void RelationMatrix::substitute(Word* vectors, std::size_t words) const {
  // The reduced row of a living generator is zero, and is the sum of the original row and other
  // rows. The generator's vector is added to the vectors that belong to these other rows.
  for (std::size_t s = steps_.size(); s-- > 0;)
    for (std::size_t i = steps_[s].begin; i < end_of(s); ++i)
      // mutant: relation-dead
      bits::add(vectors + added_[i] * words, vectors + steps_[s].to * words, words);
}

}  // namespace ph
