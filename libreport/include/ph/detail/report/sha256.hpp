// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "ph/detail/io/reader.hpp"
#include "ph/run_context.hpp"

namespace ph::report {

/// SHA-256 (FIPS 180-4) of some bytes, as 64 hexadecimal digits. @throws Error (cancelled).
std::string sha256_hex(std::span<const std::byte> bytes,
                       const RunContext& context = default_context());
/// The SHA-256 of an input. An input that stays in its file is read block by block, with at most
/// one block in memory.
std::string sha256_hex(const Input& input, const RunContext& context = default_context());

}  // namespace ph::report
