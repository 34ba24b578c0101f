// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "ph/detail/core/bit_matrix.hpp"
#include "rips/relations/relation_matrix.hpp"

namespace ph {

/// Sums of generators over Z/2 as rows of bits, and relations between generators that are stored
/// to be solved together. 0 is the empty sum.
class SumRows {
 public:
  using Generator = RelationMatrix::Row;
  using Sum = std::uint32_t;
  using Word = bits::Word;

  /// Of a row for so many generators, and some to come.
  static std::size_t words_for(std::size_t generators) {
    return (generators + generators / 8) / 64 + 1;
  }
  /// @param rows sums of so many generators, each of words_for(generators) words. @param memory for
  /// all else.
  SumRows(std::size_t generators, std::pmr::vector<Word>&& rows, std::pmr::memory_resource* memory)
      : words_(words_for(generators)),
        generators_(generators),
        rows_(std::move(rows)),
        values_(memory),
        matrix_(generators, memory) {}

  std::size_t count() const { return rows_.size() / words_; }
  std::size_t words() const { return words_; }  ///< of a row
  const Word* operator[](Sum a) const { return rows_.data() + a * words_; }
  /// A generator of the next number as a sum.
  Sum append_generator();
  Sum add(Sum a, Sum b);

  /// Stores that the sum of these is zero from now on. @return false if it is empty.
  bool add_relation(std::span<const Sum, 4> sums);
  std::size_t relation_count() const { return values_.size() / words_; }
  /// Solves those stored. @return for each of them the generator that dies of it, or
  /// RelationMatrix::kNone; valid until the next call.
  std::span<const Generator> solve();
  const RelationMatrix& matrix() const { return matrix_; }

 private:
  /// A new sum, empty.
  Word* append();
  void widen();

  std::size_t words_, generators_;
  std::pmr::vector<Word> rows_;
  std::pmr::vector<Word> values_;  // relations stored
  RelationMatrix matrix_;          // its rows are the generators
};

}  // namespace ph
