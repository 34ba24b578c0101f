// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <new>
#include <span>
#include <vector>

#include "ph/detail/core/chain.hpp"
#include "ph/detail/core/field.hpp"
#include "ph/detail/core/raw_vector.hpp"

namespace ph::alpha {

/// A reduced column. The object itself holds the coefficient of the pivot; the terms below the
/// pivot, in which edges are given by number, follow the object in memory.
template <Field K>
class Column {
 public:
  using Element = typename K::Element;
  using Term = Entry<std::uint32_t, K>;

  Column(std::uint32_t number, std::uint32_t facet, Element pivot, std::uint32_t size)
      : number_(number), facet_(facet), size_(size), pivot_(pivot) {}
  std::uint32_t number() const { return number_; }
  /// The critical facet whose boundary was reduced to this column.
  std::uint32_t facet() const { return facet_; }
  Element pivot() const { return pivot_; }
  std::span<const Term> below() const { return {reinterpret_cast<const Term*>(this + 1), size_}; }

 private:
  std::uint32_t number_;
  std::uint32_t facet_, size_;
  Element pivot_;
};

/// The columns of one thread. They do not move, because other threads read them.
template <Field K>
class ColumnStore {
  using Term = typename Column<K>::Term;
  using Unit = std::uint32_t;
  static_assert(alignof(Column<K>) == sizeof(Unit) && alignof(Term) == sizeof(Unit) &&
                sizeof(Column<K>) % sizeof(Unit) == 0 && sizeof(Term) % sizeof(Unit) == 0 &&
                std::is_trivially_copyable_v<Term>);

 public:
  explicit ColumnStore(std::pmr::memory_resource* memory) : blocks_(memory) {}

  /// @param below the terms below the pivot; their cells are of type EdgeName.
  template <class Terms>
  const Column<K>* keep(std::uint32_t number, std::uint32_t facet, typename K::Element pivot,
                        const Terms& below) {
    constexpr std::size_t block = 1 << 18;
    const std::size_t units = (sizeof(Column<K>) + below.size() * sizeof(Term)) / sizeof(Unit);
    if (blocks_.empty() || blocks_.back().capacity() - blocks_.back().size() < units) {
      blocks_.emplace_back();
      blocks_.back().reserve(std::max(block, units));
    }
    auto& into = blocks_.back();
    into.resize(into.size() + units);
    auto* const column = new (into.data() + into.size() - units)
        Column<K>(number, facet, pivot, static_cast<std::uint32_t>(below.size()));
    auto* to = reinterpret_cast<Term*>(column + 1);
    for (const auto& term : below) new (to++) Term(term.cell.edge, term.coefficient());
    return column;
  }

 private:
  std::pmr::vector<RawVector<Unit>> blocks_;
};

}  // namespace ph::alpha
