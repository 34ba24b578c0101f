// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "ph/detail/io/reader.hpp"
#include "ph/run_context.hpp"

namespace ph::report {

/// SHA-256 (FIPS 180-4) of bytes that come piece by piece.
class Sha256 {
 public:
  explicit Sha256(const RunContext& context = default_context()) : context_(context) {}

  /// @throws Error (cancelled).
  void add(std::span<const std::byte> bytes);
  /// Adds all bytes of an input. An input that stays in its file is read block by block, with at
  /// most one block in memory.
  void add(const Input& input);
  /// The hash of all bytes, as 64 hexadecimal digits.
  std::string hex() const;

 private:
  static constexpr std::size_t kBlock = 64;  // in bytes

  void add(std::span<const std::byte> bytes, Ticker& ticker);

  const RunContext& context_;
  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::byte, kBlock> rest_{};  // the bytes of a block that is not full
  std::uint64_t bytes_ = 0;
};

/// The SHA-256 of an input.
std::string sha256_hex(const Input& input, const RunContext& context = default_context());

}  // namespace ph::report
