// SPDX-License-Identifier: MIT
#include "ph/core/file_pages.hpp"

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#endif

namespace ph {

void forget_file_pages(const void* begin, std::size_t bytes) {
#if defined(__linux__)
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto first = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t from = (first + page - 1) / page * page, to = (first + bytes) / page * page;
  if (from < to) ::madvise(reinterpret_cast<void*>(from), to - from, MADV_DONTNEED);
#else
  static_cast<void>(begin);
  static_cast<void>(bytes);
#endif
}

}  // namespace ph
