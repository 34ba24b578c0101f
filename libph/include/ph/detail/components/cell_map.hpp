// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory_resource>
#include <vector>

#include "ph/filtration.hpp"

namespace ph {

/// A map from the cells of one dimension to 32-bit numbers: an array if the filtration numbers its
/// cells, otherwise a hash table with linear probing. Allocates through the given resource.
///
/// FlatMap cannot be used, because its keys have 64 bits, whereas a cell may be wider and has its
/// own hash.
template <Filtration F>
class CellMap {
 public:
  using Cell = typename F::Cell;
  static constexpr std::uint32_t kAbsent = UINT32_MAX;

  CellMap(const F&, std::pmr::memory_resource* memory) : slots_(memory) {}

  std::size_t size() const { return size_; }

  /// The number stored for `cell`, or kAbsent if there is none.
  std::uint32_t find(const Cell& cell) const {
    if (size_ == 0) return kAbsent;
    for (std::size_t i = start(cell);; i = (i + 1) & mask()) {
      if (slots_[i].value == kAbsent) return kAbsent;
      if (slots_[i].cell == cell) return slots_[i].value;
    }
  }
  /// Precondition: `cell` is absent, `value` is not kAbsent.
  void insert(const Cell& cell, std::uint32_t value) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    place({cell, value});
    ++size_;
  }

 private:
  struct Slot {
    Cell cell{};
    std::uint32_t value = kAbsent;
  };
  std::size_t mask() const { return slots_.size() - 1; }
  std::size_t start(const Cell& cell) const {
    return (std::hash<Cell>{}(cell)*0x9E3779B97F4A7C15U >> 20) & mask();
  }
  void place(const Slot& slot) {
    std::size_t i = start(slot.cell);
    while (slots_[i].value != kAbsent) i = (i + 1) & mask();
    slots_[i] = slot;
  }
  void grow() {
    std::pmr::vector<Slot> old(std::max<std::size_t>(64, 2 * slots_.size()), Slot{},
                               slots_.get_allocator());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.value != kAbsent) place(slot);
  }

  std::pmr::vector<Slot> slots_;  // a power of two, at most half full
  std::size_t size_ = 0;
};

template <SlottedFiltration F>
class CellMap<F> {
 public:
  using Cell = typename F::Cell;
  static constexpr std::uint32_t kAbsent = UINT32_MAX;

  CellMap(const F& filtration, std::pmr::memory_resource* memory)
      : filtration_(&filtration), values_(filtration.slot_count(), kAbsent, memory) {}

  std::uint32_t find(const Cell& cell) const { return values_[filtration_->slot(cell)]; }
  void insert(const Cell& cell, std::uint32_t value) { values_[filtration_->slot(cell)] = value; }

 private:
  const F* filtration_;
  std::pmr::vector<std::uint32_t> values_;
};

}  // namespace ph
