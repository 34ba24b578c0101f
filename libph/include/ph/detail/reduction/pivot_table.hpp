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

/// The part of a column that a reduction keeps once the column has a pivot; it never changes after
/// that.
template <class Cell, Field K>
struct ReducedColumn {
  Cell pivot;
  typename K::Element coefficient;        // coefficient of the pivot; zero if there is no pivot
  std::span<const Entry<Cell, K>> chain;  // the cells that were added to the column's own cell
};

/// Maps a cell to the column whose pivot it is, shared by threads without locks (Morozov &
/// Nigmetov, Towards lockless parallel computation of persistence diagrams, 2020). Columns are
/// numbers 0 … columns - 1; lower numbers take precedence.
///
/// A column is published, then claims its pivot: it takes the pivot's slot if that is free or holds
/// a higher column, which then has to be reduced further and published again. As a result, the
/// numbers in a slot only decrease, and each slot keeps its cell. A reader may find, in a slot, a
/// column that has another pivot by now. The reader then looks at the slot again: the slot changed
/// before that column was published again.
///
/// FlatMap cannot be used, because several threads insert and replace at once, by compare-and-swap.
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

  /// The last publication of column `i`; null if there is none.
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
  /// The column that holds a pivot, or kNone.
  Owner owner_of(const Cell& pivot) const { return slots_.empty() ? Owner() : find(pivot).owner; }

  /// Column `i` claims the pivot of `column`, which must outlive the table.
  /// @return i if it had to give way to a lower column; the number of the higher column that it
  /// drove out; kNone if the pivot was free. No thread but the caller's may hold column `i`.
  std::uint32_t claim(std::uint32_t i, const Column* column) {
    publish(i, column);
    for (;;) {
      Found found = find(column->pivot);
      if (found.owner.number != kNone && found.owner.number < i) return i;  // mutant: pivot-first
      if (slots_[found.slot].compare_exchange_weak(found.content, content(column->pivot, i),
                                                   std::memory_order_acq_rel))
        return found.owner.number;
    }
  }

 private:
  // A slot holds 0, or the high half of the hash of its cell followed by 1 + the number of the
  // column.
  using Slot = std::uint64_t;
  struct Found {
    std::size_t slot;
    Slot content;  // content of the slot when it was read
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
  // A number of slots that is a power of two, at most half of them full; or one slot per cell.
  std::pmr::vector<std::atomic<Slot>> slots_;
};

}  // namespace ph
