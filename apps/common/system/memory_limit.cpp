// SPDX-License-Identifier: MIT
#include "apps/common/system/memory_limit.hpp"

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>

#include "ph/detail/core/machine_memory.hpp"

namespace ph::app {
namespace {

// Sanitizers map much more memory than the program requests.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif

}  // namespace

HeapBound::HeapBound() {
  rlimit data{};
  if (!kIsSanitized && getrlimit(RLIMIT_DATA, &data) == 0) at_start_ = data.rlim_cur;
}

HeapBound::~HeapBound() {
  if (bound_) set(*at_start_);
}

void HeapBound::bound(std::size_t bytes) {
  // This reserve is for small blocks, the allocator's own data and stacks of threads.
  constexpr std::uint64_t slack = std::uint64_t{16} << 20;
  const auto now = status_bytes("VmData:");  // the memory that RLIMIT_DATA counts
  std::uint64_t limit = 0;
  if (!at_start_ || !now) return;
  // The free end of the heap counts as data of the process, but it is not in use.
  const std::uint64_t taken = *now - std::min<std::uint64_t>(*now, mallinfo2().keepcost);
  if (__builtin_add_overflow(taken + slack, bytes, &limit)) return;
  if (limit >= *at_start_) return;
  bound_ = limit;
  set(limit);
}

void HeapBound::loosen() {
  constexpr std::uint64_t holes = std::uint64_t{4} << 20;
  if (bound_) set(*bound_ + std::min(holes, *at_start_ - *bound_));
}

void HeapBound::set(std::uint64_t limit) const {
  rlimit data{};
  if (getrlimit(RLIMIT_DATA, &data) != 0) return;
  data.rlim_cur = limit;
  setrlimit(RLIMIT_DATA, &data);
}

}  // namespace ph::app
