// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "ph/detail/core/bit_matrix.hpp"
#include "ph/detail/core/field.hpp"

namespace ph {

/// Operations on functions from vertices to a field. A function is an array that the caller owns,
/// in blocks of 64 vertices. Its units are field elements, or words of 64 values over Z/2. Masks
/// are rows of bits. Each operation takes the number of blocks to process.
template <Field K>
struct VertexFunction {
  using Unit = typename K::Element;
  using Element = typename K::Element;
  using Word = bits::Word;
  static constexpr std::size_t kUnitsPerBlock = 64;

  static Element value(const Unit* row, std::size_t v) { return row[v]; }
  static void add_at(Unit* row, std::size_t v, Element a, const K& field) {
    row[v] = field.add(row[v], a);
  }
  /// Prefetches a value that is about to change.
  static void prefetch(Unit* row, std::size_t v) { __builtin_prefetch(row + v, 1); }
  /// Computes to += scale * from.
  static void add(Unit* to, const Unit* from, Element scale, const K& field, std::size_t blocks) {
    for (std::size_t v = 0; v < 64 * blocks; ++v)
      if (!field.is_zero(from[v])) to[v] = field.add(to[v], field.multiply(scale, from[v]));
  }
  /// Adds a constant to the values on a mask.
  static void shift(Unit* row, const Word* mask, Element by, const K& field, std::size_t blocks) {
    bits::for_each(mask, 0, blocks, [&](std::size_t v) { row[v] = field.add(row[v], by); });
  }
  /// Sets out = a + b - constant on the mask and leaves it unchanged elsewhere. @return true if any
  /// of these values is not zero.
  static bool difference(Unit* out, const Unit* a, const Unit* b, Element constant,
                         const Word* mask, const K& field, std::size_t blocks) {
    bool any = false;
    const Element negated = field.negate(constant);
    bits::for_each(mask, 0, blocks, [&](std::size_t v) {
      out[v] = field.add(field.add(a[v], b[v]), negated);
      any |= !field.is_zero(out[v]);
    });
    return any;
  }
  /// True if a + b is a constant on the mask.
  static bool is_sum(Element constant, const Unit* a, const Unit* b, const Word* mask,
                     const K& field, std::size_t blocks) {
    bool is_sum = true;
    bits::for_each(mask, 0, blocks,
                   [&](std::size_t v) { is_sum = is_sum && field.add(a[v], b[v]) == constant; });
    return is_sum;
  }
  /// Sets out = constant - a on the mask and leaves it unchanged elsewhere.
  static void assign(Unit* out, const Unit* a, Element constant, const Word* mask, const K& field,
                     std::size_t blocks) {
    bits::for_each(mask, 0, blocks,
                   [&](std::size_t v) { out[v] = field.add(constant, field.negate(a[v])); });
  }
  /// Makes the row zero outside the mask. @return true if any value is not zero.
  static bool restrict(Unit* row, const Word* mask, std::size_t blocks) {
    bool any = false;
    for (std::size_t v = 0; v < 64 * blocks; ++v) {
      if (!(mask[v / 64] >> (v % 64) & 1)) row[v] = 0;
      any |= row[v] != 0;
    }
    return any;
  }
  static bool is_zero(const Unit* row, std::size_t blocks) {
    return std::all_of(row, row + 64 * blocks, [](Unit a) { return a == 0; });
  }
  /// Calls `visit(vertex, value)` for the non-zero values, by ascending vertex.
  template <class Visit>
  static void for_each(const Unit* row, std::size_t blocks, Visit&& visit) {
    for (std::size_t v = 0; v < 64 * blocks; ++v)
      if (row[v] != 0) visit(v, row[v]);
  }
  /// The first vertex that is not before `from` and whose value is not zero. Returns bits::kNone if
  /// there is no such vertex.
  static std::size_t first(const Unit* row, std::size_t from, std::size_t blocks) {
    for (std::size_t v = from; v < 64 * blocks; ++v)
      if (row[v] != 0) return v;
    return bits::kNone;
  }
  /// The value on more than half of the mask's vertices (Boyer-Moore). If there is no such value,
  /// the value on the first vertex.
  static Element majority(const Unit* row, const Word* mask, const K& field, std::size_t blocks) {
    Element candidate = field.from_int(0);
    std::size_t votes = 0, count = 0, size = 0;
    bits::for_each(mask, 0, blocks, [&](std::size_t v) {
      if (votes == 0) candidate = row[v];
      votes += row[v] == candidate ? 1 : std::size_t(-1);
    });
    bits::for_each(mask, 0, blocks, [&](std::size_t v) {
      ++size;
      count += row[v] == candidate ? 1 : 0;
    });
    return 2 * count > size ? candidate : row[bits::first_common(mask, mask, blocks)];
  }
};

template <>
struct VertexFunction<Z2> {
  using Unit = bits::Word;
  using Element = Z2::Element;
  using Word = bits::Word;
  static constexpr std::size_t kUnitsPerBlock = 1;

  static Element value(const Unit* row, std::size_t v) { return row[v / 64] >> (v % 64) & 1; }
  static void add_at(Unit* row, std::size_t v, Element a, const Z2&) {
    row[v / 64] ^= Word{a} << (v % 64);
  }
  static void prefetch(Unit* row, std::size_t v) { __builtin_prefetch(row + v / 64, 1); }
  static void add(Unit* to, const Unit* from, Element scale, const Z2&, std::size_t blocks) {
    const Word all = Word{0} - Word{scale};
    for (std::size_t k = 0; k < blocks; ++k) to[k] ^= from[k] & all;
  }
  static void shift(Unit* row, const Word* mask, Element by, const Z2&, std::size_t blocks) {
    add(row, mask, by, {}, blocks);
  }
  static bool difference(Unit* out, const Unit* a, const Unit* b, Element constant,
                         const Word* mask, const Z2&, std::size_t blocks) {
    return bits::difference(out, a, b, Word{0} - Word{constant}, mask, blocks);
  }
  static bool is_sum(Element constant, const Unit* a, const Unit* b, const Word* mask, const Z2&,
                     std::size_t blocks) {
    const Word all = Word{0} - Word{constant};
    Word differs = 0;
    for (std::size_t k = 0; k < blocks; ++k) differs |= (a[k] ^ b[k] ^ all) & mask[k];
    return differs == 0;
  }
  static void assign(Unit* out, const Unit* a, Element constant, const Word* mask, const Z2&,
                     std::size_t blocks) {
    const Word all = Word{0} - Word{constant};
    for (std::size_t k = 0; k < blocks; ++k)
      out[k] = (out[k] & ~mask[k]) | ((a[k] ^ all) & mask[k]);
  }
  static bool restrict(Unit* row, const Word* mask, std::size_t blocks) {
    Word any = 0;
    for (std::size_t k = 0; k < blocks; ++k) any |= row[k] &= mask[k];
    return any != 0;
  }
  static bool is_zero(const Unit* row, std::size_t blocks) {
    return std::all_of(row, row + blocks, [](Unit a) { return a == 0; });
  }
  template <class Visit>
  static void for_each(const Unit* row, std::size_t blocks, Visit&& visit) {
    bits::for_each(row, 0, blocks, [&](std::size_t v) { visit(v, true); });
  }
  static std::size_t first(const Unit* row, std::size_t from, std::size_t blocks) {
    Word skip = ~Word{0} << (from % 64);
    for (std::size_t k = from / 64; k < blocks; ++k, skip = ~Word{0})
      if (const Word rest = row[k] & skip; rest != 0)
        return k * 64 + static_cast<std::size_t>(std::countr_zero(rest));
    return bits::kNone;
  }
  static Element majority(const Unit* row, const Word* mask, const Z2&, std::size_t blocks) {
    std::size_t count = 0, size = 0;
    for (std::size_t k = 0; k < blocks; ++k) {
      count += static_cast<std::size_t>(std::popcount(row[k] & mask[k]));
      size += static_cast<std::size_t>(std::popcount(mask[k]));
    }
    if (2 * count == size) return value(row, bits::first_common(mask, mask, blocks));
    return 2 * count > size;
  }
};

/// A pool that lends rows of zeros and takes rows back.
template <Field K>
class RowPool {
 public:
  using Unit = typename VertexFunction<K>::Unit;
  using Id = std::uint32_t;

  RowPool(std::size_t blocks, std::pmr::memory_resource* memory)
      : units_(blocks * VertexFunction<K>::kUnitsPerBlock), chunks_(memory), free_(memory) {}

  Id take() {
    if (free_.empty()) {
      const auto first = static_cast<Id>(chunks_.size() * kRowsPerChunk);
      chunks_.emplace_back(units_ * kRowsPerChunk);
      for (Id i = kRowsPerChunk; i-- > 0;) free_.push_back(first + i);
    }
    const Id id = free_.back();
    free_.pop_back();
    std::fill_n((*this)[id], units_, Unit{});
    return id;
  }
  void give(Id id) { free_.push_back(id); }
  /// The units of a row. They stay in place when other rows are taken.
  Unit* operator[](Id id) {
    return chunks_[id / kRowsPerChunk].data() + id % kRowsPerChunk * units_;
  }
  const Unit* operator[](Id id) const {
    return chunks_[id / kRowsPerChunk].data() + id % kRowsPerChunk * units_;
  }

 private:
  static constexpr Id kRowsPerChunk = 1024;
  std::size_t units_;
  std::pmr::vector<std::pmr::vector<Unit>> chunks_;
  std::pmr::vector<Id> free_;
};

}  // namespace ph
