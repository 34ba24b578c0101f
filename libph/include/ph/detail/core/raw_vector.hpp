// SPDX-License-Identifier: MIT
#pragma once
#include <memory_resource>
#include <new>
#include <type_traits>
#include <vector>

namespace ph {

/// Leaves elements that are made without a value as the memory is.
template <class T>
class RawAllocator : public std::pmr::polymorphic_allocator<T> {
 public:
  static_assert(std::is_trivial_v<T>);
  using std::pmr::polymorphic_allocator<T>::polymorphic_allocator;
  using std::pmr::polymorphic_allocator<T>::construct;
  template <class U>
  void construct(U* p) noexcept {
    ::new (static_cast<void*>(p)) U;
  }
};

/// A vector for what is written before it is read: to resize it touches no memory, so that the
/// threads that write are the first ones to do so.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace ph
