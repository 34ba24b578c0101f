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

#include "ph/detail/core/bit_matrix.hpp"
#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/field.hpp"

namespace ph {

/// The generators that died. Each of them is a combination of older generators, some of which may
/// have died later. Dead generators are substituted in a vector when the vector is read, in one
/// pass for all deaths since it was last read. The reason is that most deaths never affect most
/// vectors.
template <Field K>
class DeadGenerators {
 public:
  using Generator = std::uint32_t;  ///< numbered by birth: the youngest has the largest number
  using Term = Entry<Generator, K>;
  using Vector = std::pmr::vector<Term>;  ///< ascending generators without zeros

  DeadGenerators(const K& field, std::pmr::memory_resource* memory)
      : field_(field),
        combinations_(memory),
        bits_(memory),
        dead_(memory),
        for_vectors_(memory),
        for_combinations_(memory) {}

  /// Number of dead generators.
  std::uint32_t count() const { return count_; }
  bool contains(Generator g) const { return (dead_word(g / 64) >> (g % 64) & 1) != 0; }
  bool occur_in(std::span<const Term> vector) const {
    return std::ranges::any_of(vector, [&](const Term& t) { return contains(t.cell); });
  }
  /// Kills the youngest generator of a relation. @param relation a sum that becomes zero; all its
  /// generators must be alive.
  void add(std::span<const Term> relation);
  /// Substitutes the dead generators in a vector, which may become empty.
  void eliminate_from(Vector& vector);

 private:
  using Word = bits::Word;
  using Element = typename K::Element;
  static constexpr bool kIsZ2 = std::same_as<K, Z2>;
  static constexpr std::uint32_t kNone = UINT32_MAX;

  /// The combination that replaces a dead generator.
  struct Combination {
    using allocator_type = std::pmr::polymorphic_allocator<>;
    explicit Combination(allocator_type allocator) : terms(allocator) {}
    Combination(Combination&&) noexcept = default;
    Combination(Combination&& other, allocator_type allocator)
        : terms(std::move(other.terms), allocator), bits(other.bits), seen(other.seen) {}
    Vector terms;                // empty if the combination is stored as bits
    std::uint32_t bits = kNone;  // index into bits_
    std::uint32_t seen = 0;      // number of deaths already substituted in it
  };
  /// A vector over Z/2 with many terms, stored as one bit per generator. Vectors in this form are
  /// faster to add.
  struct Bits {
    using allocator_type = std::pmr::polymorphic_allocator<>;
    explicit Bits(allocator_type allocator) : words(allocator) {}
    Bits(Bits&&) noexcept = default;
    Bits(Bits&& other, allocator_type allocator)
        : words(std::move(other.words), allocator), begin(other.begin) {}
    std::pmr::vector<Word> words;
    std::size_t begin = 0;  // number of its first word
  };
  /// A vector to which other vectors are added, in any order of their terms.
  struct Accumulator {
    explicit Accumulator(std::pmr::memory_resource* memory) : met(memory), values(memory) {}
    std::pmr::vector<Word> met;        // one bit per generator, set if it has occurred
    std::pmr::vector<Element> values;  // value of each generator; empty over Z/2
    std::size_t begin = 0, end = 0;    // range of the words of `met` that are not zero

    /// @param words number of words of the vectors that will be added.
    void reset(std::size_t words) {
      begin = end = words;
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
    void add(const Bits& other) {
      begin = std::min(begin, other.begin);
      // mutant: dead-bits
      bits::add(met.data() + other.begin, other.words.data(), other.words.size());
    }
    /// Returns the value of a generator that has occurred, and resets the value. It may be zero.
    Element take(Generator g) {
      if constexpr (kIsZ2)
        return true;
      else
        return std::exchange(values[g], 0);
    }
    std::span<const Word> words() const { return std::span(met).subspan(begin, end - begin); }
    std::size_t count() const {
      return bits::count_common(words().data(), words().data(), words().size());
    }
    void clear() {
      std::fill(met.begin() + static_cast<std::ptrdiff_t>(begin),
                met.begin() + static_cast<std::ptrdiff_t>(end), Word{0});
    }
  };

  Word dead_word(std::size_t k) const { return k < dead_.size() ? dead_[k] : 0; }
  bool occur_in(const Combination& c) const;
  /// Computes sum += scale * combination.
  void add(Accumulator& sum, const Combination& c, Element scale) const {
    if (kIsZ2 && c.bits != kNone)
      sum.add(bits_[c.bits]);
    else
      sum.add(c.terms, scale, field_);
  }
  /// The combination that replaces a dead generator. Later deaths are first substituted in the
  /// combination. The result is stored, which saves work for the next caller.
  const Combination& updated(Generator g);
  /// @param combination_of returns the replacement of a dead generator.
  template <class Find>
  void eliminate(Accumulator& sum, Find&& combination_of);
  /// Moves the content of a sum into a vector or a combination, and empties the sum. A combination
  /// that is stored as bits stays in this form.
  void take_terms(Accumulator& sum, Vector& terms);
  void take(Accumulator& sum, Combination& c);

  const K& field_;
  std::uint32_t count_ = 0;
  std::pmr::vector<Combination> combinations_;  // by generator; empty for living generators
  std::pmr::vector<Bits> bits_;
  std::pmr::vector<Word> dead_;  // one bit per generator
  // There are two accumulators, because a combination may be updated while a vector is being
  // updated.
  Accumulator for_vectors_, for_combinations_;
};

template <Field K>
void DeadGenerators<K>::add(std::span<const Term> relation) {
  const Term youngest = relation.back();
  const auto scale = field_.negate(field_.inverse(youngest.coefficient()));  // mutant: dead-sign
  const Generator g = youngest.cell;
  if (combinations_.size() <= g) {
    combinations_.resize(g + 1);
    dead_.resize(g / 64 + 1, 0);
  }
  dead_[g / 64] |= Word{1} << (g % 64);
  Accumulator& sum = for_combinations_;
  sum.reset(g / 64 + 1);
  sum.add(relation.first(relation.size() - 1), scale, field_);
  take(sum, combinations_[g]);
  combinations_[g].seen = ++count_;
}

template <Field K>
void DeadGenerators<K>::eliminate_from(Vector& vector) {
  if (vector.empty()) return;
  Accumulator& sum = for_vectors_;
  sum.reset(vector.back().cell / 64 + 1);
  sum.add(vector, field_.from_int(1), field_);
  eliminate(sum, [&](Generator g) -> const Combination& { return updated(g); });
  take_terms(sum, vector);
}

template <Field K>
bool DeadGenerators<K>::occur_in(const Combination& c) const {
  if (!kIsZ2 || c.bits == kNone) return occur_in(c.terms);
  const Bits& b = bits_[c.bits];
  if (b.begin >= dead_.size()) return false;
  const std::size_t words = std::min(b.words.size(), dead_.size() - b.begin);
  return bits::any_common(b.words.data(), dead_.data() + b.begin, words);
}

template <Field K>
auto DeadGenerators<K>::updated(Generator g) -> const Combination& {
  Combination& c = combinations_[g];
  if (std::exchange(c.seen, count_) == count_ || !occur_in(c)) return c;
  Accumulator& sum = for_combinations_;
  sum.reset(g / 64 + 1);
  add(sum, c, field_.from_int(1));
  eliminate(sum, [&](Generator other) -> const Combination& { return combinations_[other]; });
  take(sum, c);
  return c;
}

template <Field K>
template <class Find>
void DeadGenerators<K>::eliminate(Accumulator& sum, Find&& combination_of) {
  Word* const met = sum.met.data();
  // The loop goes down from the youngest generator, because substitution adds only older
  // generators.
  for (std::size_t k = std::min(sum.end, dead_.size()); k-- > sum.begin;)
    while (const Word dead = met[k] & dead_[k]) {  // mutant: dead-by-dead
      const auto bit = static_cast<std::size_t>(std::bit_width(dead)) - 1;
      met[k] ^= Word{1} << bit;
      const auto g = static_cast<Generator>(k * 64 + bit);
      const Element value = sum.take(g);
      if (!field_.is_zero(value)) add(sum, combination_of(g), value);
    }
}

template <Field K>
void DeadGenerators<K>::take_terms(Accumulator& sum, Vector& terms) {
  terms.clear();
  terms.reserve(sum.count());
  bits::for_each(sum.met.data(), sum.begin, sum.end, [&](std::size_t g) {
    const Element value = sum.take(static_cast<Generator>(g));
    if (!field_.is_zero(value)) terms.emplace_back(static_cast<Generator>(g), value);
  });
  sum.clear();
}

template <Field K>
void DeadGenerators<K>::take(Accumulator& sum, Combination& c) {
  constexpr std::size_t many = 16;  // fewer terms are not worth another block of memory
  const auto words = sum.words();
  if (kIsZ2 && c.bits == kNone && sum.count() >= std::max(many, words.size())) {
    c.bits = static_cast<std::uint32_t>(bits_.size());
    bits_.emplace_back();
    Vector(c.terms.get_allocator()).swap(c.terms);
  }
  if (!kIsZ2 || c.bits == kNone) return take_terms(sum, c.terms);
  bits_[c.bits].words.assign(words.begin(), words.end());
  bits_[c.bits].begin = sum.begin;  // mutant: dead-bits-begin
  sum.clear();
}

}  // namespace ph
