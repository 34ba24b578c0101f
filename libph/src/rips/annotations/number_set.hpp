// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "ph/detail/core/bit_matrix.hpp"

namespace ph {

/// A set of small numbers that are assigned in ascending order. While the set is small, or sparse
/// among the numbers assigned so far, it is stored as an unsorted list. Otherwise it is stored as a
/// row of bits, and never becomes a list again.
class NumberSet {
 public:
  using Id = std::uint32_t;
  using allocator_type = std::pmr::polymorphic_allocator<>;

  explicit NumberSet(allocator_type allocator) : list_(allocator), bits_(allocator) {}
  NumberSet(NumberSet&&) noexcept = default;
  NumberSet(NumberSet&& other, allocator_type allocator)
      : list_(std::move(other.list_), allocator), bits_(std::move(other.bits_), allocator) {}

  /// Adds a number that is not in the set.
  void insert(Id id) {
    if (bits_.empty()) {
      list_.push_back(id);
      if (list_.size() > kMostListed && list_.size() * kLeastShare > id) use_bits();
    } else {
      set(id);
    }
  }
  /// Removes a number that is in the set.
  void erase(Id id) {
    if (bits_.empty()) {
      *std::ranges::find(list_, id) = list_.back();
      list_.pop_back();
    } else {
      bits_[id / 64] &= ~(Word{1} << (id % 64));
    }
  }
  /// Replaces the set by its symmetric difference with another set.
  void add(const NumberSet& other) {
    // mutant: number-set-grows
    if (bits_.size() < other.bits_.size() && !bits_.empty()) bits_.resize(other.bits_.size());
    if (!bits_.empty() && !other.bits_.empty()) {
      for (std::size_t k = 0; k < other.bits_.size(); ++k) bits_[k] ^= other.bits_[k];
    } else {
      other.for_each([&](Id id) { has(id) ? erase(id) : insert(id); });
    }
  }
  bool has(Id id) const {
    if (bits_.empty()) return std::ranges::find(list_, id) != list_.end();
    return id / 64 < bits_.size() && (bits_[id / 64] >> (id % 64) & 1) != 0;
  }
  /// Calls `visit(id)` for each number. The set must not change during the call.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const Id id : list_) visit(id);
    bits::for_each(bits_.data(), 0, bits_.size(),
                   [&](std::size_t id) { visit(static_cast<Id>(id)); });
  }

 private:
  using Word = bits::Word;
  // Lists are kept short because they are searched from the beginning. The bits take at most 16
  // times the memory of the list.
  static constexpr std::size_t kMostListed = 64, kLeastShare = 512;

  void set(Id id) {
    if (id / 64 >= bits_.size()) bits_.resize(id / 64 + 1);
    bits_[id / 64] |= Word{1} << (id % 64);
  }
  void use_bits() {
    for (const Id id : list_) set(id);
    std::pmr::vector<Id>(list_.get_allocator()).swap(list_);
  }

  std::pmr::vector<Id> list_;
  std::pmr::vector<Word> bits_;  // empty as long as the set is a list
};

}  // namespace ph
