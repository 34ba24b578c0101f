// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

namespace ph {

/// Asks the system to put the large parts of a fresh block on huge pages, which means fewer page
/// faults and fewer misses of the address cache. Must be called before the block is touched. The
/// system may ignore the request.
void prefer_huge_pages(void* block, std::size_t bytes);

/// No machine has smaller pages; mapped blocks are aligned to this size.
constexpr std::size_t kSmallestPage = 4096;

/// The memory that a block of `map_pages` takes. It consists of complete pages, or of complete huge
/// pages if the block nearly fills them.
std::size_t mapped_size(std::size_t bytes);
/// Maps a block of pages, and uses huge pages as far as the block fills them. Huge pages cause
/// fewer page faults, and random reads miss the address cache less often.
/// @throws std::bad_alloc
void* map_pages(std::size_t bytes);
/// Gives a block of `map_pages` back to the system.
void unmap_pages(void* block, std::size_t bytes);

/// Gives the complete pages inside a block back to the system. The block stays allocated, but its
/// content is lost.
void drop_pages(void* block, std::size_t bytes);

}  // namespace ph
