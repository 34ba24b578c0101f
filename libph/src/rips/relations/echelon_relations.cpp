// SPDX-License-Identifier: MIT
#include "libph/src/rips/relations/echelon_relations.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "libph/src/core/for_each_target.hpp"

namespace ph {

void EchelonRelations::add(std::span<const Generator> sum) {
  if (sum.empty()) return;
  end_ = std::max(end_, words_to(sum.back()));
  if (row_.size() < end_) row_.resize(end_, 0);
  for (const Generator g : sum) row_[g / 64] ^= Word{1} << (g % 64);
}

auto EchelonRelations::reduce() -> Generator {
  const std::size_t words = std::exchange(end_, 0);
  if (of_.size() < words * 64) of_.resize(words * 64);
  const Generator g = eliminate(row_.data(), words, of_.data());
  if (g == kNone) return kNone;
  of_[g] = store(g);
  ++dead_count_;
  std::fill_n(row_.begin(), words_to(g), Word{0});
  return g;
}

PH_FOR_EACH_TARGET
auto EchelonRelations::eliminate(Word* row, std::size_t words, Relation* of) -> Generator {
  for (std::size_t k = words; k-- > 0;)
    while (row[k] != 0) {
      const auto g = static_cast<Generator>(k * 64 + std::bit_width(row[k]) - 1);
      Relation& relation = of[g];
      if (relation.count == 0) return g;
      if (relation.is_list) {
        for (std::size_t i = 0; i < relation.count; ++i)
          row[relation.list[i] / 64] ^= Word{1} << (relation.list[i] % 64);
        continue;
      }
      Word* const other = relation.row;
      std::uint64_t count = 0;
      for (std::size_t i = 0; i <= k; ++i) {
        count += static_cast<std::uint64_t>(std::popcount(row[i]));
        row[i] ^= other[i];
      }
      if (count >= relation.count) continue;
      // mutant: relation-sparser
      for (std::size_t i = 0; i <= k; ++i) other[i] ^= row[i];  // the former content of the row
      relation.count = static_cast<std::uint32_t>(count);
    }
  return kNone;
}

auto EchelonRelations::store(Generator youngest) -> Relation {
  constexpr std::size_t few = 8, sparse = 16;  // number of terms, number of words per term
  const std::size_t words = words_to(youngest);
  Relation result;
  result.count = static_cast<std::uint32_t>(bits::count_common(row_.data(), row_.data(), words));
  result.is_list = result.count <= few || words > sparse * result.count;
  std::pmr::polymorphic_allocator<> memory(&arena_);
  if (result.is_list) {
    Generator* to = result.list = memory.allocate_object<Generator>(result.count);
    bits::for_each(row_.data(), 0, words,
                   [&](std::size_t g) { *to++ = static_cast<Generator>(g); });
  } else {
    result.row = memory.allocate_object<Word>(words);
    std::copy_n(row_.data(), words, result.row);
  }
  return result;
}

void EchelonRelations::substitute(Word* vectors, std::size_t generators, std::size_t words) const {
  // The other generators of the relation that killed g are older than g, and their vectors are
  // already final.
  for (Generator g = 0; g < generators; ++g) {
    if (!is_dead(g)) continue;
    const auto add = [=, to = vectors + g * words](std::size_t h) {
      if (h == g) return;
      for (std::size_t k = 0; k < words; ++k) to[k] ^= vectors[h * words + k];
    };
    const Relation& relation = of_[g];
    if (relation.is_list)
      std::for_each_n(relation.list, relation.count, add);
    else
      bits::for_each(relation.row, 0, words_to(g), add);
  }
}

}  // namespace ph
