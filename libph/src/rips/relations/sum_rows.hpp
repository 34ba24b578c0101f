// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "libph/src/rips/relations/relation_matrix.hpp"
#include "ph/detail/core/bit_matrix.hpp"

namespace ph {

/// Sums of generators over Z/2 as rows of bits, and relations between generators, which are
/// collected and then solved together. The sum with number 0 is empty.
class SumRows {
 public:
  using Generator = RelationMatrix::Row;
  using Sum = std::uint32_t;
  using Word = bits::Word;

  /// The number of words per row for the given number of generators, with room for some more
  /// generators.
  static std::size_t words_for(std::size_t generators) {
    return (generators + generators / 8) / 64 + 1;
  }
  /// @param rows the first sums, as rows of words_for(generators) words each. @param memory used
  /// for everything except `rows`.
  SumRows(std::size_t generators, std::pmr::vector<Word>&& rows, std::pmr::memory_resource* memory)
      : words_(words_for(generators)),
        generators_(generators),
        rows_(std::move(rows)),
        values_(memory),
        matrix_(generators, memory) {}

  std::size_t count() const { return rows_.size() / words_; }
  std::size_t words() const { return words_; }  ///< words per row
  const Word* operator[](Sum a) const { return rows_.data() + a * words_; }
  /// Adds a new generator, and the sum that consists of it alone.
  Sum append_generator();
  Sum add(Sum a, Sum b);

  /// Stores the relation that the total of these sums is zero. @return false if the total is empty.
  bool add_relation(std::span<const Sum, 4> sums);
  std::size_t relation_count() const { return values_.size() / words_; }
  /// Solves the stored relations. @return for each relation, the generator that it kills, or
  /// RelationMatrix::kNone. The result is valid until the next call.
  std::span<const Generator> solve();
  const RelationMatrix& matrix() const { return matrix_; }

 private:
  /// Adds an empty sum.
  Word* append();
  void widen();

  std::size_t words_, generators_;
  std::pmr::vector<Word> rows_;
  std::pmr::vector<Word> values_;  // stored relations
  RelationMatrix matrix_;          // the rows represent generators
};

}  // namespace ph
