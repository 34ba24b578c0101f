// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <functional>
#include <memory_resource>
#include <span>
#include <vector>

#include "ph/detail/core/chain.hpp"
#include "ph/filtration.hpp"

namespace ph {

/// What a reduction keeps of a column once it has a pivot; never changed after that.
template <class Cell, Field K>
struct ReducedColumn {
  Cell pivot;
  typename K::Element coefficient;        // of the pivot; zero if there is none
  std::span<const Entry<Cell, K>> chain;  // what was added to the column's own cell
};

/// Which column has a cell as its pivot, shared by threads without locks (Morozov & Nigmetov,
/// Towards lockless parallel computation of persistence diagrams, 2020). Columns are numbers 0 …
/// columns - 1; lower ones prevail.
///
/// A column is published, then claims its pivot: it takes the pivot's slot if that is free or holds
/// a higher column, which then has to be reduced further and published again. So the numbers in a
/// slot only fall, and each slot keeps its cell. A reader that finds in a slot a column which by
/// now has another pivot looks at the slot again: it has changed before that column was published
/// again.
///
/// No FlatMap: several threads insert and replace at once, by compare-and-swap.
template <CofacetFiltration F, Field K>
class PivotTable {
 public:
  using Cell = typename F::Cell;
  using Column = ReducedColumn<Cell, K>;
  static constexpr std::uint32_t kNone = UINT32_MAX;

  PivotTable(const F& filtration, std::size_t columns, std::pmr::memory_resource* memory)
      : published_(columns, memory), slots_(slot_count(filtration, columns), memory) {
    if constexpr (SlottedFiltration<F>) filtration_ = &filtration;
  }

  /// What column `i` published last; null if nothing.
  const Column* column(std::uint32_t i) const {
    return published_[i].load(std::memory_order_acquire);
  }

  void publish(std::uint32_t i, const Column* column) {
    published_[i].store(column, std::memory_order_release);
  }

  struct Owner {
    std::uint32_t number = kNone;
    const Column* column = nullptr;
  };
  /// The column that holds a pivot; kNone if none does.
  Owner owner_of(const Cell& pivot) const { return slots_.empty() ? Owner() : find(pivot).owner; }

  /// Column `i` wants the pivot of `column`, which outlives the table.
  /// @return i if it had to give way to a lower column; the higher one that it has driven out;
  /// kNone if the pivot was free. Threads may hold no column `i` but the caller's.
  std::uint32_t claim(std::uint32_t i, const Column* column) {
    publish(i, column);
    for (;;) {
      Found found = find(column->pivot);
      if (found.owner.number != kNone && found.owner.number < i) return i;
      if (slots_[found.slot].compare_exchange_weak(found.content, content(column->pivot, i),
                                                   std::memory_order_acq_rel))
        return found.owner.number;
    }
  }

 private:
  // A slot holds 0, or the high half of the hash of its cell above 1 + the number of the column.
  using Slot = std::uint64_t;
  struct Found {
    std::size_t slot;
    Slot content;  // of the slot, when it was looked at
    Owner owner;
  };

  static std::size_t slot_count(const F& filtration, std::size_t columns) {
    if constexpr (SlottedFiltration<F>)
      return columns == 0 ? 0 : filtration.slot_count();
    else
      return columns == 0 ? 0 : std::bit_ceil(2 * columns);
  }
  static std::uint64_t hash(const Cell& cell) {
    return std::hash<Cell>{}(cell)*0x9E3779B97F4A7C15U;
  }
  static Slot content(const Cell& cell, std::uint32_t number) {
    return (hash(cell) & 0xFFFFFFFF00000000U) | (Slot{number} + 1);
  }

  Found find(const Cell& pivot) const {
    std::size_t slot;
    if constexpr (SlottedFiltration<F>)
      slot = filtration_->slot(pivot);
    else
      slot = (hash(pivot) >> 20) & (slots_.size() - 1);
    for (;;) {
      const Slot content = slots_[slot].load(std::memory_order_acquire);
      if (content == 0) return {slot, content, {}};
      const auto number = static_cast<std::uint32_t>(content) - 1;
      const bool is_it = SlottedFiltration<F> || ((content ^ hash(pivot)) >> 32) == 0;
      if (is_it) {
        const Column* column = published_[number].load(std::memory_order_acquire);
        if (column && column->pivot == pivot) return {slot, content, {number, column}};
        if (slots_[slot].load(std::memory_order_acquire) != content) continue;
      }
      slot = (slot + 1) & (slots_.size() - 1);
    }
  }

  const F* filtration_ = nullptr;
  std::pmr::vector<std::atomic<const Column*>> published_;  // by column
  std::pmr::vector<std::atomic<Slot>> slots_;  // a power of two, at most half full; or one a cell
};

}  // namespace ph
