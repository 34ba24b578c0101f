// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace ph {

/// A part of a result in its stored form: its kind, its content, and a checksum that shows whether
/// the part is complete and undamaged. The layout: eight bytes "ph part\n", eight bytes for the
/// kind, the version as 32 bits, the size of the content as 64 bits, the content, and the CRC-32 of
/// everything before it.
///
/// @param kind at most eight characters: "image". @param content the bytes of the part.
std::vector<std::byte> sealed_part(std::string_view kind, std::span<const std::byte> content);

/// True if bytes begin like a part.
bool is_sealed_part(std::span<const std::byte> bytes);

/// The kind of a part. @throws Error (bad_data) if the bytes are not a complete part.
std::string_view kind_of_part(std::span<const std::byte> bytes);

/// The content of a part. @throws Error (bad_data) if the bytes are not a complete part of this
/// kind.
std::span<const std::byte> content_of_part(std::span<const std::byte> bytes, std::string_view kind);

}  // namespace ph
