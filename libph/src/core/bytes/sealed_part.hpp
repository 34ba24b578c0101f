// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace ph {

/// A part of a result as it is stored and sent: what it is, and a checksum that says whether all of
/// it arrived. Eight bytes "ph part\n", eight bytes of its kind, the version as 32 bits, the number
/// of bytes that follow as 64 bits, these bytes, and the CRC-32 of all that is before it.
///
/// @param kind at most eight characters: "image". @param content what the part says.
std::vector<std::byte> sealed_part(std::string_view kind, std::span<const std::byte> content);

/// Whether bytes begin as a part does.
bool is_sealed_part(std::span<const std::byte> bytes);

/// The kind of a part. @throws Error (bad_data) if it is none, or not whole.
std::string_view kind_of_part(std::span<const std::byte> bytes);

/// What a part says. @throws Error (bad_data) if it is none, not whole, or of another kind.
std::span<const std::byte> content_of_part(std::span<const std::byte> bytes, std::string_view kind);

}  // namespace ph
