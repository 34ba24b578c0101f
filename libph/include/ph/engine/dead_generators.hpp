// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "ph/core/bit_matrix.hpp"
#include "ph/core/chain.hpp"
#include "ph/core/field.hpp"

namespace ph {

/// What became of generators that died: each is a combination of older ones, some of which may have
/// died later. A vector in terms of generators learns of deaths when it is looked at, of all since
/// it was last looked at in one pass; most vectors never learn of most deaths.
template <Field K>
class DeadGenerators {
 public:
  using Generator = std::uint32_t;  ///< numbered by birth: the youngest has the largest number
  using Term = Entry<Generator, K>;
  using Vector = std::pmr::vector<Term>;  ///< ascending generators, no zeros

  DeadGenerators(const K& field, std::pmr::memory_resource* memory)
      : field_(field),
        combinations_(memory),
        dead_(memory),
        for_vectors_(memory),
        for_combinations_(memory) {}

  /// How many have died.
  std::uint32_t count() const { return count_; }
  bool contains(Generator g) const { return (dead_word(g / 64) >> (g % 64) & 1) != 0; }
  bool occur_in(std::span<const Term> vector) const {
    return std::ranges::any_of(vector, [&](const Term& t) { return contains(t.cell); });
  }
  /// @param relation zero from now on: its youngest generator dies. The others are alive.
  void add(Vector&& relation);
  /// Puts in what became of the dead ones, which may leave nothing.
  void eliminate_from(Vector& vector) {
    eliminate(vector, for_vectors_, [&](Generator g) { return std::span(updated(g)); });
  }

 private:
  using Word = bits::Word;
  using Element = typename K::Element;
  static constexpr bool kIsZ2 = std::same_as<K, Z2>;
  struct Combination {
    using allocator_type = std::pmr::polymorphic_allocator<>;
    explicit Combination(allocator_type allocator) : terms(allocator) {}
    Combination(Combination&&) noexcept = default;
    Combination(Combination&& other, allocator_type allocator)
        : terms(std::move(other.terms), allocator), seen(other.seen) {}
    Vector terms;
    std::uint32_t seen = 0;  // how many deaths it has learnt of
  };
  /// A vector that terms are added to in any order.
  struct Row {
    explicit Row(std::pmr::memory_resource* memory) : met(memory), values(memory) {}
    std::pmr::vector<Word> met;        // a bit for each generator; all zero between uses
    std::pmr::vector<Element> values;  // by generator, zero where none was met; none over Z/2
    std::size_t begin = 0;             // of the words of those met

    void reset(std::size_t words) {
      begin = words;
      if (met.size() >= words) return;
      met.resize(words, 0);
      if constexpr (!kIsZ2) values.resize(words * 64, 0);
    }
    void add(std::span<const Term> terms, Element scale, const K& field) {
      if (terms.empty()) return;
      begin = std::min<std::size_t>(begin, terms.front().cell / 64);
      for (const Term& t : terms) {
        Word& word = met[t.cell / 64];
        const Word bit = Word{1} << (t.cell % 64);
        if constexpr (kIsZ2) {
          word ^= bit;
        } else {
          word |= bit;
          values[t.cell] = field.add(values[t.cell], field.multiply(scale, t.coefficient()));
        }
      }
    }
    /// The value of one that was met, which may be zero.
    Element take(Generator g) {
      if constexpr (kIsZ2)
        return true;
      else
        return std::exchange(values[g], 0);
    }
  };

  Word dead_word(std::size_t k) const { return k < dead_.size() ? dead_[k] : 0; }
  /// The combination of a dead generator. It learns of deaths since: whoever needs it next finds
  /// hardly any dead ones in it.
  const Vector& updated(Generator g);
  /// @param combination_of what a dead generator is replaced by.
  template <class Find>
  void eliminate(Vector& vector, Row& row, Find&& combination_of);

  const K& field_;
  std::uint32_t count_ = 0;
  std::pmr::vector<Combination> combinations_;  // by generator; of those that live none
  std::pmr::vector<Word> dead_;                 // a bit for each generator
  Row for_vectors_, for_combinations_;          // a combination is updated while a vector is
};

template <Field K>
void DeadGenerators<K>::add(Vector&& relation) {
  const Term youngest = relation.back();
  relation.pop_back();
  const auto scale = field_.negate(field_.inverse(youngest.coefficient()));
  for (Term& t : relation) t = Term(t.cell, field_.multiply(scale, t.coefficient()));
  const Generator g = youngest.cell;
  if (combinations_.size() <= g) {
    combinations_.resize(g + 1);
    dead_.resize(g / 64 + 1, 0);
  }
  dead_[g / 64] |= Word{1} << (g % 64);
  combinations_[g].terms = std::move(relation);
  combinations_[g].seen = ++count_;
}

template <Field K>
auto DeadGenerators<K>::updated(Generator g) -> const Vector& {
  Combination& combination = combinations_[g];
  if (std::exchange(combination.seen, count_) != count_ && occur_in(combination.terms))
    eliminate(combination.terms, for_combinations_, [&](Generator other) {
      return std::span(std::as_const(combinations_[other].terms));
    });
  return combination.terms;
}

template <Field K>
template <class Find>
void DeadGenerators<K>::eliminate(Vector& vector, Row& row, Find&& combination_of) {
  if (vector.empty()) return;
  const std::size_t end = vector.back().cell / 64 + 1;
  row.reset(end);
  row.add(vector, field_.from_int(1), field_);
  for (std::size_t k = end; k-- > row.begin;)  // from the youngest down: what comes in is older
    while (const Word dead = row.met[k] & dead_word(k)) {
      const auto bit = static_cast<std::size_t>(std::bit_width(dead)) - 1;
      row.met[k] ^= Word{1} << bit;
      const auto g = static_cast<Generator>(k * 64 + bit);
      const Element value = row.take(g);
      if (!field_.is_zero(value)) row.add(combination_of(g), value, field_);
    }
  const Word* met = row.met.data();
  vector.clear();
  vector.reserve(bits::count_common(met + row.begin, met + row.begin, end - row.begin));
  bits::for_each(met, row.begin, end, [&](std::size_t g) {
    const Element value = row.take(static_cast<Generator>(g));
    if (!field_.is_zero(value)) vector.emplace_back(static_cast<Generator>(g), value);
  });
  std::fill(row.met.begin() + static_cast<std::ptrdiff_t>(row.begin),
            row.met.begin() + static_cast<std::ptrdiff_t>(end), Word{0});
}

}  // namespace ph
