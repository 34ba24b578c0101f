// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ph::segment {

// A stored tree: a header of numbers of eight bytes, little endian, int64 or float64; the arrays; a
// checksum. What can be found again from the rest (elder and younger of a merge, sizes) is not
// stored: it cannot contradict it then.
inline constexpr std::string_view kTreeMagic = "ph-tree\n";
inline constexpr std::int64_t kTreeVersion = 1;
inline constexpr std::size_t kTreeWord = 8, kTreeHeader = 25 * kTreeWord;
inline constexpr std::size_t kTreeSum = 4;

/// CRC-32 of all that stands before it.
std::uint32_t tree_sum(std::string_view bytes);

}  // namespace ph::segment
