// SPDX-License-Identifier: MIT
#pragma once
#include <memory_resource>
#include <string_view>
#include <vector>

#include "ph/detail/io/reader.hpp"

namespace ph::detail {

/// Limits for the expansion of compressed data, whatever the budget: a file of a few kilobytes that
/// claims gigabytes is a bomb.
constexpr std::size_t kMostFree = std::size_t{128} << 20;  ///< bytes that are always allowed
/// The limit beyond them, as a multiple of the packed size.
constexpr std::size_t kMostExpansion = 256;

/// True if the bytes start like a gzip file.
bool is_gzip(std::string_view bytes);

/// The unpacked size of its last member that a gzip file states, modulo 2^32.
std::size_t stated_size(std::string_view packed);

/// All members of a gzip file, one after another.
/// @param most the largest unpacked size that is allowed, however small the file is.
/// @throws Error (bad_data) if it is damaged, truncated, has trailing data or expands beyond
///         reason; Error (resource) beyond `most`.
std::pmr::vector<char> gunzip(const Input& packed, std::size_t most);

/// The same into a temporary file, of any reasonable size. @throws as gunzip; Error (io).
ScratchFile gunzip_to_file(const Input& packed);

/// Unpacks a raw deflate stream that must end with its bytes and give exactly `size` bytes.
/// @param offset start of `packed` in the input, for messages.
/// @throws Error (bad_data).
std::pmr::vector<char> inflate_raw(const Input& input, std::size_t offset, std::size_t packed_size,
                                   std::size_t size);

/// The CRC-32 of zip and gzip.
std::uint32_t checksum(std::span<const char> bytes);

/// The memory for large buffers of an input: the run's budget, if it has one.
std::pmr::memory_resource* memory_of(const Input& input);

}  // namespace ph::detail
