// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace ph {

/// A pool that lends empty lists and takes lists back.
template <class T>
class ListPool {
 public:
  using Id = std::uint32_t;
  explicit ListPool(std::pmr::memory_resource* memory) : lists_(memory), free_(memory) {}

  Id take() {
    if (free_.empty()) {
      lists_.emplace_back();
      return static_cast<Id>(lists_.size() - 1);
    }
    const Id id = free_.back();
    free_.pop_back();
    return id;
  }
  void give(Id id) {
    constexpr std::size_t kept = 64;  // lists up to this size keep their memory
    if (lists_[id].capacity() > kept) std::pmr::vector<T>(lists_.get_allocator()).swap(lists_[id]);
    lists_[id].clear();
    free_.push_back(id);
  }
  /// Prefetches the location of a list. `prefetch_terms` then prefetches the content of the list.
  /// Both functions should be called some time before the list is used.
  void prefetch(Id id) const { __builtin_prefetch(&lists_[id]); }
  void prefetch_terms(Id id) const {
    // Both constants are numbers of bytes. The hardware prefetches the rest of a long list.
    constexpr std::size_t line = 64, most = 512;
    const auto* const begin = reinterpret_cast<const char*>(lists_[id].data());
    const std::size_t bytes = std::min(lists_[id].size() * sizeof(T), most);
    for (std::size_t at = 0; at <= bytes; at += line) __builtin_prefetch(begin + at, 1);
  }
  std::pmr::vector<T>& operator[](Id id) { return lists_[id]; }
  const std::pmr::vector<T>& operator[](Id id) const { return lists_[id]; }

 private:
  std::pmr::vector<std::pmr::vector<T>> lists_;
  std::pmr::vector<Id> free_;
};

}  // namespace ph
