// SPDX-License-Identifier: MIT
#pragma once
namespace ph::app {

/// Sets up what the program needs of the process: standard descriptors that are open and pass bytes
/// as they are, errors in place of signals where nobody reads an output or a disk is full, an
/// allocator that keeps freed blocks.
void prepare_process();

/// Whether a descriptor is open and was when the program started: not one of its own, which all
/// close in programs that it starts.
bool is_given(int descriptor);

/// The allocator keeps none of the blocks that were freed.
void give_back_freed_memory();

}  // namespace ph::app
