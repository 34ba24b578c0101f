// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace ph::detail {

// LZF, the compression inside PCD files: runs of literals (a byte n < 32, then n + 1 bytes) and
// matches (three bits of length, thirteen of distance) that repeat what was written before.

/// Where and why decompression failed; `reason` is null if it did not.
struct LzfFault {
  const char* reason = nullptr;
  std::size_t offset = 0;  ///< into the compressed bytes
};

/// No compressed byte stands for more bytes than this.
constexpr std::size_t kLzfMaxExpansion = 88;

/// Fills `out` exactly, or says what is wrong. Never reads or writes outside of the spans.
LzfFault lzf_decompress(std::span<const std::byte> in, std::span<std::byte> out);

/// Compresses; in the worst case the result is a thirty-second longer.
std::vector<std::byte> lzf_compress(std::span<const std::byte> in);

}  // namespace ph::detail
