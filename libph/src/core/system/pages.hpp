// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

namespace ph {

/// Asks the system to put what is large enough of a fresh block on huge pages, before it is
/// touched: fewer faults, fewer misses of the address cache. A hint: what comes of it is the
/// system's business.
void prefer_huge_pages(void* block, std::size_t bytes);

/// No machine has smaller pages, so blocks that are mapped are aligned to it.
constexpr std::size_t kSmallestPage = 4096;

/// How much of the memory a block of pages takes: whole pages, and whole huge ones if it fills them
/// nearly.
std::size_t mapped_size(std::size_t bytes);
/// A block of pages of its own, on huge ones as far as it fills them: few faults, and what is read
/// in no order misses the address cache less often.
/// @throws std::bad_alloc
void* map_pages(std::size_t bytes);
/// Gives a block of `map_pages` back to the system.
void unmap_pages(void* block, std::size_t bytes);

/// Gives the memory under a block back to the system, as far as it is whole pages. The block stays
/// allocated; what was in it is lost.
void drop_pages(void* block, std::size_t bytes);

}  // namespace ph
