// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

namespace ph {

/// Asks the system to put what is large enough of a fresh block on huge pages, before it is
/// touched: fewer faults, fewer misses of the address cache. A hint: what comes of it is the
/// system's business.
void prefer_huge_pages(void* block, std::size_t bytes);

/// Gives the memory under a block back to the system, as far as it is whole pages. The block stays
/// allocated; what was in it is lost.
void drop_pages(void* block, std::size_t bytes);

}  // namespace ph
