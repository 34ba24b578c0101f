// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace ph::detail {

// LZF is the compression inside PCD files. The compressed data consist of runs of literals (a byte
// n < 32, then n + 1 bytes) and matches that repeat earlier output (three bits of length, thirteen
// bits of distance).

/// The reason and the place of a decompression error. `reason` is null if there was no error.
struct LzfFault {
  const char* reason = nullptr;
  std::size_t offset = 0;  ///< offset into the compressed bytes
};

/// A compressed byte never expands to more than this number of bytes.
constexpr std::size_t kLzfMaxExpansion = 88;

/// Receives the decompressed bytes in order, piece by piece.
using LzfSink = std::function<void(std::span<const std::byte>)>;

/// Decompresses exactly `size` bytes through a small window. @return the fault, if there is one.
LzfFault lzf_decompress(std::span<const std::byte> in, std::size_t size, const LzfSink& sink);

/// Compresses bytes. In the worst case, the result is 1/32 longer than the input.
std::vector<std::byte> lzf_compress(std::span<const std::byte> in);

}  // namespace ph::detail
