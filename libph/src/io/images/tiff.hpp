// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libph/src/io/bytes/readers.hpp"

namespace ph::detail {

/// The numbers of a TIFF field, which are read from the file when they are needed.
struct TiffNumbers {
  std::size_t count = 0, at = 0;
  std::size_t bytes_each = 0;  ///< 1, 2, 4 or 8
  std::endian order = std::endian::little;

  /// Precondition: i < count. The bytes are in the file.
  std::size_t number(const Input& input, std::size_t i) const;
};

/// The ways to compress a chunk.
enum class TiffCompression {
  none = 1,
  lzw = 5,
  deflate = 8,
  pack_bits = 32773,
  old_deflate = 32946
};

/// A page of a TIFF file: one picture, in strips or tiles, which are called chunks.
struct TiffPage {
  std::size_t number = 0;  ///< counted from 1
  std::size_t at = 0;      ///< the place of its directory
  std::size_t width = 0, height = 0;
  std::size_t bits = 1, samples = 1;  ///< bits per sample, samples per pixel
  std::size_t format = 1;             ///< 1 unsigned, 2 signed, 3 float
  std::size_t photometric = 1;        ///< 0 grey from white to black, 1 grey, 2 RGB
  std::size_t predictor = 1;          ///< 1 none, 2 differences, 3 differences of float bytes
  TiffCompression compression = TiffCompression::none;
  std::endian order = std::endian::little;
  bool is_tiled = false;
  std::size_t chunk_width = 0, chunk_height = 0;
  TiffNumbers offsets, sizes;  ///< one per chunk
  std::size_t kind = 0;        ///< bits: 1 reduced resolution, 4 transparency mask
  std::string_view description;

  /// True for a page that repeats another one in a lower resolution, and for a mask. Only its kind
  /// is read.
  bool is_left_out() const { return (kind & 5U) != 0; }

  std::size_t chunks_across() const { return (width - 1) / chunk_width + 1; }
  std::size_t chunks_down() const { return (height - 1) / chunk_height + 1; }
  /// The bytes of a row of a chunk.
  std::size_t row_bytes() const { return (chunk_width * samples * bits + 7) / 8; }
  /// The rows of the chunk that are in the file.
  std::size_t rows_of(std::size_t chunk) const {
    const std::size_t first = chunk / chunks_across() * chunk_height;
    return is_tiled ? chunk_height : std::min(chunk_height, height - first);
  }
  /// The name of a chunk in messages: "strip 3" or "tile 3".
  std::string place(std::size_t chunk) const;
};

/// Reads the directories of all pages, and checks them against the file. @throws Error (bad_data)
/// also on pages that no function here can decode.
std::vector<TiffPage> read_tiff_pages(const Input& input);

/// Decodes a chunk into bytes whose numbers have this machine's byte order. Samples of one bit stay
/// packed, eight per byte. @param to has rows_of(chunk) * row_bytes() bytes.
/// @return true if the chunk has more data than that. @throws Error (bad_data) if it has less.
bool decode_tiff_chunk(const Input& input, const TiffPage& page, std::size_t chunk,
                       std::span<std::byte> to);

/// Decompresses LZW as in TIFF. @return the number of bytes written, or nothing if the data are
/// damaged. `more` becomes true if the data continue after the last byte of `to`.
std::optional<std::size_t> unpack_lzw(std::span<const std::byte> from, std::span<std::byte> to,
                                      bool& more);

}  // namespace ph::detail
