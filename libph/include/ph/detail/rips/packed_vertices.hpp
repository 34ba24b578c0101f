// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <compare>
#include <cstdint>

namespace ph {

/// The vertices of a simplex packed into `Words` machine words, `bits` bits per vertex: slot 0, the
/// lowest bits, holds the smallest vertex. Simplices of one dimension compare like their vertices
/// read from the largest down (colexicographic order), as fast as integers.
template <int Words>
class PackedVertices {
 public:
  static constexpr int kBits = 64 * Words;

  PackedVertices() = default;
  constexpr explicit PackedVertices(std::uint64_t vertex) { word(0) = vertex; }

  // The defaulted operator would call memcmp.
  friend constexpr bool operator==(const PackedVertices& a, const PackedVertices& b) {
    for (int i = 0; i < Words; ++i)
      if (a.word(i) != b.word(i)) return false;
    return true;
  }
  friend constexpr auto operator<=>(const PackedVertices&, const PackedVertices&) = default;

  /// The lowest `count` bits (0 … 63) as a number.
  constexpr std::uint64_t low_bits(int count) const {
    return word(0) & ((std::uint64_t{1} << count) - 1);
  }
  constexpr PackedVertices operator|(const PackedVertices& b) const {
    PackedVertices r;
    for (int i = 0; i < Words; ++i) r.word(i) = word(i) | b.word(i);
    return r;
  }
  constexpr PackedVertices operator<<(int n) const {
    PackedVertices r;
    if (n >= kBits) return r;
    if constexpr (Words == 1) return PackedVertices(word(0) << n);
    const int whole = n / 64, rest = n % 64;
    for (int i = Words - 1; i >= whole; --i) {
      r.word(i) = word(i - whole) << rest;
      if (rest != 0 && i > whole) r.word(i) |= word(i - whole - 1) >> (64 - rest);
    }
    return r;
  }
  constexpr PackedVertices operator>>(int n) const {
    PackedVertices r;
    if (n >= kBits) return r;
    if constexpr (Words == 1) return PackedVertices(word(0) >> n);
    const int whole = n / 64, rest = n % 64;
    for (int i = 0; i + whole < Words; ++i) {
      r.word(i) = word(i + whole) >> rest;
      if (rest != 0 && i + whole + 1 < Words) r.word(i) |= word(i + whole + 1) << (64 - rest);
    }
    return r;
  }
  std::size_t hash() const {
    std::uint64_t h = 0;
    for (const std::uint64_t w : words_) h = (h ^ w) * 0x9E3779B97F4A7C15U;
    return h ^ (h >> 32);
  }

 private:
  // words_[0] is the most significant word, which makes the defaulted comparison the numeric one.
  constexpr std::uint64_t& word(int significance) {
    return words_[static_cast<std::size_t>(Words - 1 - significance)];
  }
  constexpr std::uint64_t word(int significance) const {
    return words_[static_cast<std::size_t>(Words - 1 - significance)];
  }
  std::array<std::uint64_t, static_cast<std::size_t>(Words)> words_{};
};

}  // namespace ph
