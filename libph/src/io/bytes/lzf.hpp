// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <functional>
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

/// Takes the next decompressed bytes, piece after piece in order.
using LzfSink = std::function<void(std::span<const std::byte>)>;

/// Decompresses exactly `size` bytes through a small window, or says what is wrong.
LzfFault lzf_decompress(std::span<const std::byte> in, std::size_t size, const LzfSink& sink);

/// Compresses; in the worst case the result is a thirty-second longer.
std::vector<std::byte> lzf_compress(std::span<const std::byte> in);

}  // namespace ph::detail
