// SPDX-License-Identifier: MIT
#pragma once
#include "libph/src/io/images/volume.hpp"

namespace ph::detail {

/// The way in which the numbers of a VTI array are stored: as a count of bytes and the bytes, or as
/// blocks of zlib data after a list of their sizes.
struct VtiBytes {
  std::size_t begin = 0, end = 0;  ///< the place of the array; other arrays may follow
  std::size_t count_size = 4;      ///< the size in bytes of a count, 4 or 8
  bool is_base64 = true;           ///< false: the bytes are raw
  bool is_packed = false;          ///< true: zlib data
  bool is_last = true;             ///< only blanks may follow the array
};

/// Reads the numbers of an array. @param volume its type, byte order and extents.
/// @throws Error (bad_data) if the sizes do not fit the extents, or if the data are damaged.
Image load_vti(const Input& input, const VtiBytes& bytes, const StoredVolume& volume);

}  // namespace ph::detail
