// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <utility>
#include <vector>

namespace ph {

/// A hash table from 64-bit numbers to small values, in one array with linear probing; several
/// times faster than std::unordered_map for the look-ups of inner loops. Any 64-bit number can be a
/// key. Single keys are never erased.
template <class Value>
class FlatMap {
 public:
  using Key = std::uint64_t;

  explicit FlatMap(std::pmr::memory_resource* memory) : slots_(memory) {}

  /// Makes room for that many keys at once.
  void reserve(std::size_t keys) {
    const std::size_t slots = std::bit_ceil(2 * (keys + 1));
    if (slots > slots_.size()) rehash(std::max(kSmall, slots));
  }
  /// Prefetches the data that `find` will read. The map must not be empty, or `reserve` must have
  /// been called.
  void prefetch(Key key) const { __builtin_prefetch(&slots_[start(key)]); }
  /// Returns null if the key is absent. The result is valid until the next insertion. Several
  /// threads may call it.
  Value* find(Key key) {
    if (key == kFree) [[unlikely]]  // mutant: map-free-key
      return has_last_ ? &last_ : nullptr;
    if (size_ == 0) return nullptr;
    Slot& slot = slot_of(key);
    return slot.key == key ? &slot.value : nullptr;
  }
  const Value* find(Key key) const { return const_cast<FlatMap*>(this)->find(key); }
  /// Returns the value of a key, which is created if the key was absent, and true if the key was
  /// absent.
  std::pair<Value*, bool> try_emplace(Key key) {
    if (key == kFree) [[unlikely]]
      return {&last_, !std::exchange(has_last_, true)};
    if (2 * (size_ + 1) > slots_.size()) rehash(std::max(kSmall, 2 * slots_.size()));
    Slot& slot = slot_of(key);
    const bool is_new = slot.key == kFree;
    if (is_new) {
      slot.key = key;
      ++size_;
    }
    return {&slot.value, is_new};
  }
  /// Removes all keys, but keeps a small array, which makes frequent clearing cheap.
  void clear() {
    last_ = Value{};  // mutant: map-last-value
    has_last_ = false;
    if (size_ == 0) return;
    size_ = 0;
    if (slots_.size() <= kSmall) {
      std::fill(slots_.begin(), slots_.end(), Slot{});
    } else {
      slots_.clear();
      slots_.shrink_to_fit();
    }
  }

 private:
  static constexpr Key kFree = UINT64_MAX;  // marks a free slot; as a key it is stored in last_
  struct Slot {
    Key key = kFree;
    Value value{};
  };
  static constexpr std::size_t kSmall = 64;

  std::size_t mask() const { return slots_.size() - 1; }
  /// Fibonacci hashing: the upper bits of the product are well mixed.
  std::size_t start(Key key) const {
    return key * 0x9E3779B97F4A7C15U >> (64 - std::bit_width(mask()));
  }
  /// The slot of a key, or the slot that the key would get.
  Slot& slot_of(Key key) {
    std::size_t i = start(key);
    while (slots_[i].key != key && slots_[i].key != kFree) i = (i + 1) & mask();
    return slots_[i];
  }
  void rehash(std::size_t slots) {
    std::pmr::vector<Slot> old(slots, Slot{}, slots_.get_allocator());
    old.swap(slots_);
    for (Slot& slot : old)
      if (slot.key != kFree) slot_of(slot.key) = std::move(slot);
  }

  std::pmr::vector<Slot> slots_;  // a power of two, at most half full
  std::size_t size_ = 0;          // number of keys in the slots
  Value last_{};                  // value of the key kFree
  bool has_last_ = false;         // true if the key kFree is present
};

}  // namespace ph
