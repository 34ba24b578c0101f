// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "libph/src/rips/relations/echelon_relations.hpp"

namespace ph {

/// Sums of generators over Z/2 as lists, as if no generator had died, together with the relations
/// by which generators died. 0 is the empty sum.
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
  /// @param terms ascending.
  Sum insert(std::span<const Generator> terms);
  Sum add(Sum a, Sum b);

  /// The sum of these becomes zero. @return the generator that this kills, or
  /// EchelonRelations::kNone.
  Generator add_relation(std::span<const Sum> sums) {
    for (const Sum a : sums) relations_.add((*this)[a]);
    return relations_.reduce();
  }
  const EchelonRelations& relations() const { return relations_; }

 private:
  /// Makes a sum of the terms at the end of terms_.
  Sum end_sum();

  std::pmr::vector<std::size_t> ends_;  // start of each sum, and the end of the last one
  std::pmr::vector<Generator> terms_;
  EchelonRelations relations_;
};

}  // namespace ph
