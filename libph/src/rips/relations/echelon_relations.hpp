// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/detail/core/bit_matrix.hpp"

namespace ph {

/// Receives relations between generators over Z/2, one after another, and finds the generator that
/// each relation kills. It is the youngest generator that is left after all generators that died
/// earlier have been substituted. No two stored relations have the same youngest generator. If a
/// new relation has the same youngest generator as a stored relation, the relation with fewer terms
/// is kept and added to the other relation (Bauer, Masood, Giunti, Houry, Kerber, Rathod, Keeping
/// it sparse: computing persistent homology revisited).
class EchelonRelations {
 public:
  using Generator = std::uint32_t;  ///< numbered by birth: the youngest has the largest number
  static constexpr Generator kNone = UINT32_MAX;

  explicit EchelonRelations(std::pmr::memory_resource* memory)
      : arena_(memory), of_(memory), row_(memory) {}

  /// Adds a sum to the next relation. @param sum generators in ascending order.
  void add(std::span<const Generator> sum);
  /// Ends the next relation. @return the generator that the relation kills, or kNone if the
  /// relation follows from earlier relations.
  Generator reduce();

  std::size_t dead_count() const { return dead_count_; }
  bool is_dead(Generator g) const { return g < of_.size() && of_[g].count != 0; }
  /// Computes the vectors of dead generators from the vectors of living generators. @param vectors
  /// one vector per generator, each of `words` words. On entry, it contains the vectors of living
  /// generators, and zeros for dead generators.
  void substitute(bits::Word* vectors, std::size_t generators, std::size_t words) const;

 private:
  using Word = bits::Word;
  /// A relation. It is stored as a list if it has few generators, otherwise as one bit per
  /// generator.
  struct Relation {
    union {
      Generator* list;
      Word* row = nullptr;
    };
    std::uint32_t count = 0;  // number of terms; 0 if there is no relation
    bool is_list = false;
  };

  static std::size_t words_to(Generator g) { return g / 64 + 1; }
  /// Adds relations to a row until the youngest generator of the row is alive or the row is empty.
  /// If the row has fewer terms than a relation, the row and the relation are swapped first.
  /// @return the youngest generator, or kNone if the row is empty.
  static Generator eliminate(Word* row, std::size_t words, Relation* of);
  /// Stores the content of row_ as a relation.
  Relation store(Generator youngest);

  std::pmr::monotonic_buffer_resource arena_;  // memory of relations
  std::pmr::vector<Relation> of_;              // for each generator, the relation that killed it
  std::pmr::vector<Word> row_;                 // the next relation, which is zero between uses
  std::size_t end_ = 0;                        // end of the words in use
  std::size_t dead_count_ = 0;
};

}  // namespace ph
