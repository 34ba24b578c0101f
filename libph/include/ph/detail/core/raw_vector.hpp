// SPDX-License-Identifier: MIT
#pragma once
#include <memory_resource>
#include <new>
#include <type_traits>
#include <vector>

namespace ph {

/// An allocator that leaves elements uninitialised if they are made without a value.
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

/// A vector for data that are written before they are read: resizing it touches no memory, which
/// means that the writing threads are the first to touch each page.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace ph
