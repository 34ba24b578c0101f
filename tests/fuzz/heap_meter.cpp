// SPDX-License-Identifier: MIT
#include "tests/fuzz/heap_meter.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define PH_HAS_MALLOC_HOOKS 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PH_HAS_MALLOC_HOOKS 1
#endif
#endif

#include <algorithm>

#ifdef PH_HAS_MALLOC_HOOKS
// GCC provides these functions without a header.
extern "C" {
int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*, std::size_t),
                                              void (*on_free)(const volatile void*));
std::size_t __sanitizer_get_allocated_size(const volatile void* memory);
}
#endif

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
