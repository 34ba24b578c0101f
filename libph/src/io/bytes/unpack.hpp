// SPDX-License-Identifier: MIT
#pragma once
#include <memory_resource>
#include <string>
#include <string_view>
#include <vector>

#include "ph/detail/io/reader.hpp"

namespace ph::detail {

/// The number of bytes to which compressed data may always expand. This limit and the next one
/// apply whatever the memory budget is, because a file of a few kilobytes that expands to gigabytes
/// is a decompression bomb.
constexpr std::size_t kMostFree = std::size_t{128} << 20;
/// The largest size of a result above kMostFree, as a multiple of the packed size.
constexpr std::size_t kMostExpansion = 256;

/// True if the bytes start like a gzip file.
bool is_gzip(std::string_view bytes);

/// The unpacked size that a gzip file states for its last member, modulo 2^32.
std::size_t stated_size(std::string_view packed);

/// Compressed data from a place of an input to its end: the members of a gzip file, one after
/// another, or one zlib stream.
struct Packed {
  const Input& input;
  std::size_t offset = 0;
  std::size_t size = 0;  ///< the unpacked size that the file states, which may be false
};

/// The first bytes of the content of a gzip file, at most `most`. Damaged data end early.
/// @param packed the first bytes of the file, or all of them.
std::string unpacked_start(std::string_view packed, std::size_t most);

/// Unpacks data.
/// @param most the largest unpacked size that is allowed, even for a small file.
/// @throws Error (bad_data) if the data are damaged or truncated, have trailing data or expand too
/// much; Error (resource) if the unpacked data are larger than `most`.
std::pmr::vector<char> unpack(const Packed& packed, std::size_t most);

/// Like unpack, but unpacks into a temporary file, without a limit `most`. @throws as unpack; Error
/// (io).
ScratchFile unpack_to_file(const Packed& packed);

/// Unpacks a raw deflate stream, which must consist of exactly `packed_size` bytes and expand to
/// exactly `size` bytes.
/// @param offset the start of the stream in the input.
/// @throws Error (bad_data) if the stream is damaged or has other sizes.
std::pmr::vector<char> inflate_raw(const Input& input, std::size_t offset, std::size_t packed_size,
                                   std::size_t size);

/// Unpacks a zlib stream of `packed_size` bytes until `to` is full. `more` becomes true if the
/// stream has more data. @return the number of bytes written. @throws Error (bad_data) if the
/// stream is damaged or truncated.
std::size_t inflate_zlib(const Input& input, std::size_t offset, std::size_t packed_size,
                         std::span<std::byte> to, bool& more);

/// The CRC-32 checksum of zip and gzip.
std::uint32_t checksum(std::span<const char> bytes);

/// The memory for large buffers of an input. It is the budget of the input's run, or the heap if
/// the input belongs to no run.
std::pmr::memory_resource* memory_of(const Input& input);

}  // namespace ph::detail
