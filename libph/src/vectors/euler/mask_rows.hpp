// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>

namespace ph::vectors {

/// All bits, or none.
using Mask = std::uint8_t;

/// Finds the neighbours that precede their voxels: they are smaller or, with `or_equal`, not
/// larger. `flip` inverts all bits of the masks.
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

/// masks &= a & b & c; where all of them are set, `sum` is increased or decreased by 1.
void count_where_all(Mask* masks, const Mask* a, const Mask* b, const Mask* c, std::size_t count,
                     bool adds, std::int8_t* sum);
void count_where_all(Mask* masks, const Mask* a, const Mask* b, const Mask* c, std::size_t count,
                     bool adds, std::int16_t* sum);

}  // namespace ph::vectors
