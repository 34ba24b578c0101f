// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "libph/src/rips/sweep/sorted_terms.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/field.hpp"

namespace ph::beta_skeleton {

/// Receives relations between formal generators over any field, one after another, and finds the
/// generator that each relation kills. As long as an earlier relation has the same youngest
/// generator as the new relation, a multiple of the earlier relation is subtracted. The youngest
/// remaining generator dies. See docs/explanation/engines/formal-annotations.md.
template <Field K>
class FormalRelations {
 public:
  using Generator = std::uint32_t;  ///< numbered by birth: the youngest has the largest number
  using Term = Entry<Generator, K>;
  using Sum = std::pmr::vector<Term>;

  FormalRelations(std::size_t generators, const K& field, std::pmr::memory_resource* memory)
      : field_(field), of_(generators, memory), merged_(memory) {}

  /// Sorts the terms of a sum by generator, adds up terms of the same generator and removes zeros.
  void collect(Sum& sum) const {
    std::sort(sum.begin(), sum.end(), [](const Term& a, const Term& b) { return a.cell < b.cell; });
    auto out = sum.begin();
    for (auto it = sum.begin(); it != sum.end();) {
      const Generator g = it->cell;
      auto value = it->coefficient();
      for (++it; it != sum.end() && it->cell == g; ++it)
        value = field_.add(value, it->coefficient());
      if (!field_.is_zero(value)) *out++ = Term(g, value);
    }
    sum.erase(out, sum.end());
  }
  /// Adds a relation. @param relation the sum that becomes zero, with generators in ascending
  /// order. @return the generator that dies, or nothing.
  std::optional<Generator> add(Sum& relation) {
    while (!relation.empty()) {
      const Term youngest = relation.back();
      const Sum& other = of_[youngest.cell];
      if (other.empty()) {
        store(relation);
        return youngest.cell;
      }
      add_sorted_terms(relation, other, field_.negate(youngest.coefficient()), field_, merged_);
    }
    return std::nullopt;
  }

 private:
  /// Stores a relation, scaled to give its youngest generator the coefficient one.
  void store(const Sum& relation) {
    Sum& mine = of_[relation.back().cell];
    mine.reserve(relation.size());
    const auto scale = field_.inverse(relation.back().coefficient());
    for (const Term& t : relation)
      mine.emplace_back(t.cell, field_.multiply(scale, t.coefficient()));
  }

  const K& field_;
  std::pmr::vector<Sum> of_;  // for each generator, the relation that killed it
  Sum merged_;                // scratch
};

}  // namespace ph::beta_skeleton
