// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

namespace ph {

/// Says that what was read or written of a mapped file in this range is not needed for now: it
/// leaves the process's memory and comes back from the file when it is touched. Whole pages only.
/// A hint. Precondition: all of it is a file that is mapped, shared or never written to.
void forget_file_pages(const void* begin, std::size_t bytes);

}  // namespace ph
