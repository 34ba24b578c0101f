// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

namespace ph::app {

/// Prepares the process. The standard descriptors are then open and pass bytes unchanged. If nobody
/// reads an output, or if a disk is full, the program gets an error instead of a signal. The
/// allocator keeps freed blocks.
void prepare_process();

/// True if a descriptor is open and was open when the program started. Descriptors that the program
/// opened itself do not count.
bool is_given(int descriptor);

/// Makes the allocator return all freed blocks.
void give_back_freed_memory();

/// The largest resident memory of the process so far, in bytes.
std::uint64_t peak_memory();

}  // namespace ph::app
