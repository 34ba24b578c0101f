// SPDX-License-Identifier: MIT
#include "libph/src/core/system/pages.hpp"

#include <windows.h>

#include <cstdint>
#include <new>

namespace ph {

// On Windows, huge pages need a privilege that programs do not have.
void prefer_huge_pages(void*, std::size_t) {}

std::size_t mapped_size(std::size_t bytes) {
  const std::size_t rest = (kSmallestPage - bytes % kSmallestPage) % kSmallestPage;
  return bytes > SIZE_MAX - rest ? SIZE_MAX : bytes + rest;
}

void* map_pages(std::size_t bytes) {
  void* const block =
      VirtualAlloc(nullptr, mapped_size(bytes), MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void unmap_pages(void* block, std::size_t) { VirtualFree(block, 0, MEM_RELEASE); }

void drop_pages(void* block, std::size_t bytes) {
  // Resets the complete pages inside the block. The system need not keep their content, and they
  // may be written again.
  const auto begin = reinterpret_cast<std::uintptr_t>(block), end = begin + bytes;
  const std::uintptr_t first = (begin + kSmallestPage - 1) / kSmallestPage * kSmallestPage;
  const std::uintptr_t last = end / kSmallestPage * kSmallestPage;
  if (first < last)
    VirtualAlloc(reinterpret_cast<void*>(first), last - first, MEM_RESET, PAGE_READWRITE);
}

}  // namespace ph
