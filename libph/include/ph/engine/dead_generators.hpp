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
#include "ph/engine/sorted_terms.hpp"

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
        relations_(memory),
        dead_(memory),
        met_(memory),
        row_(memory),
        sum_(memory),
        merged_(memory) {}

  /// How many have died.
  std::uint32_t count() const { return count_; }
  bool contains(Generator g) const { return (dead_word(g / 64) >> (g % 64) & 1) != 0; }
  bool occur_in(std::span<const Term> vector) const {
    return std::ranges::any_of(vector, [&](const Term& t) { return contains(t.cell); });
  }
  /// @param relation zero from now on: its youngest generator dies. The others are alive.
  void add(Vector&& relation);
  /// Puts in what became of the dead ones, which may leave nothing.
  void eliminate_from(Vector& vector);

 private:
  using Word = bits::Word;
  struct Relation {
    using allocator_type = std::pmr::polymorphic_allocator<>;
    explicit Relation(allocator_type allocator) : terms(allocator) {}
    Relation(Relation&&) noexcept = default;
    Relation(Relation&& other, allocator_type allocator)
        : terms(std::move(other.terms), allocator), seen(other.seen) {}
    Vector terms;
    std::uint32_t seen = 0;  // how many deaths it has learnt of
  };

  Word dead_word(std::size_t k) const { return k < dead_.size() ? dead_[k] : 0; }
  /// Lets the relation of a dead generator learn of deaths since: whoever needs it next finds
  /// hardly any dead ones in it.
  void update(Generator g);
  /// Eliminates them from the first `count` terms, of which there are some; the others stay.
  void eliminate(Vector& vector, std::size_t count);
  /// sum_ = the terms without dead generators.
  void eliminate_in_row(std::span<const Term> terms);
  void eliminate_in_list(std::span<const Term> terms);

  const K& field_;
  std::uint32_t count_ = 0;
  std::pmr::vector<Relation> relations_;  // by generator; of those that live none
  std::pmr::vector<Word> dead_;           // a bit for each generator
  std::pmr::vector<Generator> met_;
  std::pmr::vector<Word> row_;  // zero between uses
  Vector sum_, merged_;
};

template <Field K>
void DeadGenerators<K>::add(Vector&& relation) {
  const Generator g = relation.back().cell;
  if (relations_.size() <= g) {
    relations_.resize(g + 1);
    dead_.resize(g / 64 + 1, 0);
  }
  dead_[g / 64] |= Word{1} << (g % 64);
  relations_[g].terms = std::move(relation);
  relations_[g].seen = ++count_;
}

template <Field K>
void DeadGenerators<K>::eliminate_from(Vector& vector) {
  met_.clear();
  for (const Term& t : vector)
    if (contains(t.cell)) met_.push_back(t.cell);
  if (met_.empty()) return;
  for (const Generator g : met_) update(g);
  eliminate(vector, vector.size());
}

template <Field K>
void DeadGenerators<K>::update(Generator g) {
  Relation& relation = relations_[g];
  if (std::exchange(relation.seen, count_) == count_) return;
  const std::size_t others = relation.terms.size() - 1;
  if (occur_in(std::span(relation.terms).first(others))) eliminate(relation.terms, others);
}

template <Field K>
void DeadGenerators<K>::eliminate(Vector& vector, std::size_t count) {
  const auto terms = std::span<const Term>(vector).first(count);
  if constexpr (std::same_as<K, Z2>)
    eliminate_in_row(terms);
  else
    eliminate_in_list(terms);
  sum_.insert(sum_.end(), vector.begin() + static_cast<std::ptrdiff_t>(count), vector.end());
  vector.assign(sum_.begin(), sum_.end());
}

template <Field K>
void DeadGenerators<K>::eliminate_in_row(std::span<const Term> terms) {
  const std::size_t end = terms.back().cell / 64 + 1;
  if (row_.size() < end) row_.resize(end, 0);
  std::size_t begin = end;  // of the words with bits
  const auto add = [&](std::span<const Term> more) {
    begin = std::min<std::size_t>(begin, more.front().cell / 64);
    for (const Term& t : more) row_[t.cell / 64] ^= Word{1} << (t.cell % 64);
  };
  add(terms);
  for (std::size_t k = end; k-- > begin;)  // from the youngest down: what comes in is older
    while (const Word dead = row_[k] & dead_word(k))
      add(relations_[k * 64 + static_cast<std::size_t>(std::bit_width(dead)) - 1].terms);
  sum_.clear();
  bits::for_each(row_.data(), begin, end, [&](std::size_t g) {
    sum_.emplace_back(static_cast<Generator>(g), field_.from_int(1));
  });
  std::fill(row_.begin() + static_cast<std::ptrdiff_t>(begin),
            row_.begin() + static_cast<std::ptrdiff_t>(end), Word{0});
}

template <Field K>
void DeadGenerators<K>::eliminate_in_list(std::span<const Term> terms) {
  sum_.assign(terms.begin(), terms.end());
  for (std::size_t living = 0; living < sum_.size();) {  // of the youngest
    const Term t = sum_[sum_.size() - 1 - living];
    if (!contains(t.cell)) {
      ++living;
      continue;
    }
    const Vector& relation = relations_[t.cell].terms;
    const auto unit = field_.inverse(relation.back().coefficient());
    add_sorted_terms<K>(sum_, relation, field_.negate(field_.multiply(t.coefficient(), unit)),
                        field_, merged_);
  }
}

}  // namespace ph
