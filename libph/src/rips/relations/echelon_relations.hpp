// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/detail/core/bit_matrix.hpp"

namespace ph {

/// Relations between generators over Z/2, one after the other, and the generator that each kills:
/// the youngest one left when those that died before are put in. No two that are kept have the same
/// youngest generator; of two that would, the one with fewer terms is kept (Bauer, Masood, Giunti,
/// Houry, Kerber, Rathod, Keeping it sparse: computing persistent homology revisited).
class EchelonRelations {
 public:
  using Generator = std::uint32_t;  ///< numbered by birth: the youngest has the largest number
  static constexpr Generator kNone = UINT32_MAX;

  explicit EchelonRelations(std::pmr::memory_resource* memory)
      : arena_(memory), of_(memory), row_(memory) {}

  /// Adds generators to the next relation. @param sum ascending.
  void add(std::span<const Generator> sum);
  /// Ends that relation. @return the generator it kills; kNone if it follows from those before.
  Generator reduce();

  std::size_t dead_count() const { return dead_count_; }
  bool is_dead(Generator g) const { return g < of_.size() && of_[g].count != 0; }
  /// Puts in what became of the dead generators. @param vectors of so many words for each of the
  /// `generators`: on entry what the living ones are, and zero for the dead.
  void substitute(bits::Word* vectors, std::size_t generators, std::size_t words) const;

 private:
  using Word = bits::Word;
  /// A relation: a list of generators if they are few, or a bit for each.
  struct Relation {
    union {
      Generator* list;
      Word* row = nullptr;
    };
    std::uint32_t count = 0;  // of terms; 0 if there is none
    bool is_list = false;
  };

  static std::size_t words_to(Generator g) { return g / 64 + 1; }
  /// Adds relations to a row, and keeps what has fewer terms, until its youngest generator lives.
  /// @return that; kNone if nothing is left.
  static Generator eliminate(Word* row, std::size_t words, Relation* of);
  /// What is in row_.
  Relation store(Generator youngest);

  std::pmr::monotonic_buffer_resource arena_;  // of relations
  std::pmr::vector<Relation> of_;              // by generator: the one that killed it
  std::pmr::vector<Word> row_;                 // the next relation; zero between uses
  std::size_t end_ = 0;                        // of its words
  std::size_t dead_count_ = 0;
};

}  // namespace ph
