// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

namespace ph {

/// Asks the system to put the large parts of a fresh block on huge pages, which cause fewer page
/// faults and fewer misses of the address cache. Must be called before the block is touched. The
/// system may ignore the request.
void prefer_huge_pages(void* block, std::size_t bytes);

/// No machine has smaller pages. Mapped blocks are aligned to this size.
constexpr std::size_t kSmallestPage = 4096;

/// The memory that a block of `map_pages` occupies. It consists of complete pages, or of complete
/// huge pages if the block nearly fills them.
std::size_t mapped_size(std::size_t bytes);
/// Maps a block of pages. The parts of the block that fill huge pages are stored on huge pages,
/// which cause fewer page faults. Random reads also miss the address cache less often.
/// @throws std::bad_alloc
void* map_pages(std::size_t bytes);
/// Returns a block of `map_pages` to the system.
void unmap_pages(void* block, std::size_t bytes);

/// Returns the complete pages inside a block to the system. The block stays allocated, but its
/// content is lost.
void drop_pages(void* block, std::size_t bytes);

}  // namespace ph
