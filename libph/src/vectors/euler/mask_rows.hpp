// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>

namespace ph::vectors {

/// A mask has either all bits set or no bit set.
using Mask = std::uint8_t;

/// Sets the masks of the voxels whose neighbours precede them. A neighbour precedes a voxel if it
/// is smaller or, with `or_equal`, not larger. The masks are then combined with `flip` by exclusive
/// or.
void find_preceding(const std::uint8_t* neighbours, const std::uint8_t* voxels, std::size_t count,
                    bool or_equal, Mask flip, Mask* out);
void find_preceding(const std::uint16_t* neighbours, const std::uint16_t* voxels, std::size_t count,
                    bool or_equal, Mask flip, Mask* out);
void find_preceding(const std::int16_t* neighbours, const std::int16_t* voxels, std::size_t count,
                    bool or_equal, Mask flip, Mask* out);
void find_preceding(const float* neighbours, const float* voxels, std::size_t count, bool or_equal,
                    Mask flip, Mask* out);
void find_preceding(const double* neighbours, const double* voxels, std::size_t count,
                    bool or_equal, Mask flip, Mask* out);

/// Computes masks &= a & b & c. Where the result is set, `sum` is increased (`adds`) or decreased
/// by 1.
void count_where_all(Mask* masks, const Mask* a, const Mask* b, const Mask* c, std::size_t count,
                     bool adds, std::int8_t* sum);
void count_where_all(Mask* masks, const Mask* a, const Mask* b, const Mask* c, std::size_t count,
                     bool adds, std::int16_t* sum);

}  // namespace ph::vectors
