// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/rips/relations/echelon_relations.hpp"

namespace ph {

/// Sums of generators over Z/2 as lists, in which dead generators are not substituted, and the
/// relations by which generators died. The sum with number 0 is empty.
class FormalSums {
 public:
  using Generator = EchelonRelations::Generator;
  using Sum = std::uint32_t;

  explicit FormalSums(std::pmr::memory_resource* memory)
      : ends_(2, 0, memory), terms_(memory), relations_(memory) {}

  std::size_t count() const { return ends_.size() - 1; }
  std::span<const Generator> operator[](Sum a) const {
    return std::span(terms_).subspan(ends_[a], ends_[a + 1] - ends_[a]);
  }
  /// Stores a sum. @param terms generators in ascending order.
  Sum insert(std::span<const Generator> terms);
  Sum add(Sum a, Sum b);

  /// Adds the relation that the total of these sums is zero. @return the generator that the
  /// relation kills, or EchelonRelations::kNone.
  Generator add_relation(std::span<const Sum> sums) {
    for (const Sum a : sums) relations_.add((*this)[a]);
    return relations_.reduce();
  }
  const EchelonRelations& relations() const { return relations_; }

 private:
  /// Ends a sum whose terms were appended to terms_.
  Sum end_sum();

  std::pmr::vector<std::size_t> ends_;  // start of each sum, and the end of the last one
  std::pmr::vector<Generator> terms_;
  EchelonRelations relations_;
};

}  // namespace ph
