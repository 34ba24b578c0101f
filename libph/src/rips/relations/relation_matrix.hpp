// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/detail/core/bit_matrix.hpp"

namespace ph {

/// Receives relations between generators over Z/2, one after another, and finds the generator that
/// each relation kills. It is the youngest generator that is left after all generators that died
/// earlier have been substituted.
///
/// The matrix has a row for each generator, from the oldest to the youngest, and a column for each
/// relation. Rows are reduced one after another, the youngest first. Younger rows are added to a
/// row until its first column is not the first column of any younger row. The relation of that
/// column killed the generator of the row. A reduction of columns gives the same pairs (de Silva,
/// Morozov, Vejdemo-Johansson, Dualities in persistent (co)homology). Here, however, relations that
/// follow from earlier relations cost nothing, and most relations follow from earlier ones.
///
/// Relations come in blocks. All additions are stored for later blocks, and for `substitute`.
class RelationMatrix {
 public:
  using Word = bits::Word;
  using Row = std::uint32_t;
  static constexpr Row kNone = UINT32_MAX;

  RelationMatrix(std::size_t rows, std::pmr::memory_resource* memory)
      : cells_(memory),
        row_of_(memory),
        is_dead_(rows, 0, memory),
        living_(rows),
        steps_(memory),
        added_(memory),
        more_(memory) {}

  /// Solves a block of relations. @param rows the number of generators, which is at least the
  /// previous number; new generators are younger. @param relations the columns, each of `words`
  /// words with one bit per generator. @return for each column, the generator that it killed, or
  /// kNone. The result is valid until the next call.
  std::span<const Row> reduce(std::size_t rows, std::size_t columns, const Word* relations,
                              std::size_t words);

  std::size_t row_count() const { return is_dead_.size(); }
  bool is_dead(Row row) const { return is_dead_[row] != 0; }
  std::size_t living_count() const { return living_; }
  /// Number of additions that are stored.
  std::size_t additions() const { return added_.size(); }
  /// Computes the vectors of dead generators from the vectors of living generators. @param vectors
  /// one vector per generator, each of `words` words. On entry, it contains the vectors of living
  /// generators, and zeros for dead generators.
  void substitute(Word* vectors, std::size_t words) const;

 private:
  struct alignas(64) Line {
    std::array<Word, 8> words{};
  };
  /// The additions to the row `to`. They are the entries of added_ from `begin` up to the start of
  /// the next step, in this order.
  struct Step {
    Row to;
    std::size_t begin;
  };

  void transpose(const Word* relations, std::size_t words);
  Word* row_begin(std::size_t row) { return cells_[row * lines_].words.data(); }
  std::size_t end_of(std::size_t step) const {
    return step + 1 < steps_.size() ? steps_[step + 1].begin : added_.size();
  }

  std::size_t lines_ = 0;  // cache lines per row
  std::pmr::vector<Line> cells_;
  std::pmr::vector<Row> row_of_;  // for each column, the row that begins there, if any
  std::pmr::vector<std::uint8_t> is_dead_;
  std::size_t living_;
  std::pmr::vector<Step> steps_;
  std::pmr::vector<Row> added_, more_;
};

}  // namespace ph
