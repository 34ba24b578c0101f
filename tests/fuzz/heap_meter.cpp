// SPDX-License-Identifier: MIT
#include "heap_meter.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define PH_HAS_MALLOC_HOOKS 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PH_HAS_MALLOC_HOOKS 1
#endif
#endif

#ifdef PH_HAS_MALLOC_HOOKS
#include <sanitizer/allocator_interface.h>
#endif

#include <algorithm>

namespace ph::fuzz {
namespace {

thread_local bool metering = false;
thread_local std::ptrdiff_t held = 0, most = 0;

#ifdef PH_HAS_MALLOC_HOOKS
void allocated(const volatile void*, std::size_t size) {
  if (!metering) return;
  held += static_cast<std::ptrdiff_t>(size);
  most = std::max(most, held);
}
void released(const volatile void* memory) {
  if (metering && memory != nullptr)
    held -= static_cast<std::ptrdiff_t>(__sanitizer_get_allocated_size(memory));
}
const bool installed = __sanitizer_install_malloc_and_free_hooks(allocated, released) > 0;
#endif

}  // namespace

HeapMeter::HeapMeter() {
  held = most = 0;
  metering = true;
}
HeapMeter::~HeapMeter() { metering = false; }
std::size_t HeapMeter::last_peak() { return static_cast<std::size_t>(most); }

}  // namespace ph::fuzz
