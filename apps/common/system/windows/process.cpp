// SPDX-License-Identifier: MIT
#include "apps/common/system/process.hpp"

#include <fcntl.h>
#include <io.h>
#include <malloc.h>

#include "apps/common/system/memory_limit.hpp"
#include "ph/detail/core/machine_memory.hpp"

namespace ph::app {

void prepare_process() {
  for (const int descriptor : {0, 1, 2}) _setmode(descriptor, _O_BINARY);
}

bool is_given(int) { return true; }  // no name refers to a descriptor on Windows

void give_back_freed_memory() { _heapmin(); }

std::uint64_t peak_memory() { return status_bytes("VmHWM:").value_or(0); }

// The system sets no limit. Only large containers are therefore limited, by the budget.
HeapBound::HeapBound() = default;
HeapBound::~HeapBound() = default;
void HeapBound::bound(std::size_t) {}
void HeapBound::loosen() {}

}  // namespace ph::app
