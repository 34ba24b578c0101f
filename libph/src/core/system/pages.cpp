// SPDX-License-Identifier: MIT
#include "core/system/pages.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <memory>

namespace ph {
namespace {

// Blocks lie on pages of 2 MiB where the system has them for those who ask: a few faults in
// place of thousands, and what is read in no order misses the table of pages less often.
constexpr std::size_t kHugePage = std::size_t{2} << 20;

// Says what the whole pages of a block are for.
void advise(void* block, std::size_t bytes, std::size_t page, int advice) {
  if (std::align(page, page, block, bytes) != nullptr) madvise(block, bytes / page * page, advice);
}

}  // namespace

void prefer_huge_pages(void* block, std::size_t bytes) {
#if defined(MADV_HUGEPAGE)
  advise(block, bytes, kHugePage, MADV_HUGEPAGE);
#endif
}

void drop_pages(void* block, std::size_t bytes) {
  advise(block, bytes, static_cast<std::size_t>(sysconf(_SC_PAGESIZE)), MADV_DONTNEED);
}

}  // namespace ph
