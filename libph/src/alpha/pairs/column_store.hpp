// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <new>
#include <span>
#include <vector>

#include "ph/detail/core/field.hpp"
#include "ph/detail/core/raw_vector.hpp"

namespace ph::alpha {

/// A reduced column: its pivot's coefficient, and what is below the pivot, behind it in memory.
template <class Term>
class Column {
 public:
  using Element = decltype(Term().coefficient());

  Column(std::uint32_t number, std::uint32_t facet, Element pivot, std::uint32_t size)
      : number_(number), facet_(facet), size_(size), pivot_(pivot) {}
  std::uint32_t number() const { return number_; }
  /// The critical facet whose boundary it was.
  std::uint32_t facet() const { return facet_; }
  Element pivot() const { return pivot_; }
  std::span<const Term> below() const { return {reinterpret_cast<const Term*>(this + 1), size_}; }

 private:
  alignas(8) std::uint32_t number_;
  std::uint32_t facet_, size_;
  Element pivot_;
};

/// Columns of one thread. They stay where they are: others read them.
template <class Term>
class ColumnStore {
  using Unit = std::uint64_t;
  static_assert(sizeof(Column<Term>) % sizeof(Unit) == 0 && sizeof(Term) % sizeof(Unit) == 0 &&
                std::is_trivially_copyable_v<Term>);

 public:
  explicit ColumnStore(std::pmr::memory_resource* memory) : blocks_(memory) {}

  const Column<Term>* keep(std::uint32_t number, std::uint32_t facet,
                           typename Column<Term>::Element pivot, std::span<const Term> below) {
    constexpr std::size_t block = 1 << 17;
    const std::size_t units = (sizeof(Column<Term>) + below.size_bytes()) / sizeof(Unit);
    if (blocks_.empty() || blocks_.back().capacity() - blocks_.back().size() < units) {
      blocks_.emplace_back();
      blocks_.back().reserve(std::max(block, units));
    }
    auto& into = blocks_.back();
    into.resize(into.size() + units);
    auto* const column = new (into.data() + into.size() - units)
        Column<Term>(number, facet, pivot, static_cast<std::uint32_t>(below.size()));
    std::uninitialized_copy(below.begin(), below.end(), reinterpret_cast<Term*>(column + 1));
    return column;
  }

 private:
  std::pmr::vector<RawVector<Unit>> blocks_;
};

}  // namespace ph::alpha
