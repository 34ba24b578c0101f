// SPDX-License-Identifier: MIT
#include "libph/src/core/system/pages.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <memory>
#include <new>

namespace ph {
namespace {

// Blocks are placed on pages of 2 MiB if the system offers them on request. Filling a block then
// causes a few page faults instead of thousands, and random reads miss the address cache (TLB) less
// often.
constexpr std::size_t kHugePage = std::size_t{2} << 20;

// Tells the system how the complete pages of a block will be used.
void advise(void* block, std::size_t bytes, std::size_t page, int advice) {
  if (std::align(page, page, block, bytes) != nullptr) madvise(block, bytes / page * page, advice);
}

// Rounds up to complete pages. A size beyond the address space remains too large.
std::size_t round_up(std::size_t bytes, std::size_t page) {
  const std::size_t rest = (page - bytes % page) % page;
  return bytes > SIZE_MAX - rest ? SIZE_MAX : bytes + rest;
}

}  // namespace

std::size_t mapped_size(std::size_t bytes) {
  // The size is rounded up to complete huge pages only if this adds at most a fifth of `bytes`.
  constexpr std::size_t nearly = 5;
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t huge = round_up(bytes, kHugePage);
  return huge - bytes > bytes / nearly ? round_up(bytes, page) : huge;
}

void* map_pages(std::size_t bytes) {
  const std::size_t size = mapped_size(bytes);
  // A huge page begins at a multiple of its size. More memory is therefore mapped than needed, and
  // the memory before and after the block is returned to the system.
  const std::size_t room = size + kHugePage;
  if (room < size) throw std::bad_alloc();
  void* const all = mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (all == MAP_FAILED) throw std::bad_alloc();
  const std::size_t before = -reinterpret_cast<std::uintptr_t>(all) % kHugePage;
  char* const block = static_cast<char*>(all) + before;
  if (before > 0) munmap(all, before);
  if (before < kHugePage) munmap(block + size, kHugePage - before);
  prefer_huge_pages(block, size);
  return block;
}

void unmap_pages(void* block, std::size_t bytes) { munmap(block, mapped_size(bytes)); }

void prefer_huge_pages(void* block, std::size_t bytes) {
#if defined(MADV_HUGEPAGE)
  advise(block, bytes, kHugePage, MADV_HUGEPAGE);
#endif
}

void drop_pages(void* block, std::size_t bytes) {
  advise(block, bytes, static_cast<std::size_t>(sysconf(_SC_PAGESIZE)), MADV_DONTNEED);
}

}  // namespace ph
