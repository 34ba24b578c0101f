// SPDX-License-Identifier: MIT
#include "libph/src/io/bytes/lzf.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace ph::detail {
namespace {

constexpr std::size_t kSlack = 32;  // the number of bytes that a copy may write beyond its end
// The approximate number of bytes sent to the sink at once.
constexpr std::size_t kPiece = std::size_t{1} << 16;
constexpr std::size_t kMaxLiterals = 32;  // the largest number of literals in a run
constexpr std::size_t kMaxDistance = 1 << 13;
constexpr std::size_t kMaxMatch = 264;
constexpr unsigned kHashBits = 14;

// Copies `length` bytes to `to` from the position `distance` bytes before it. If the two ranges
// overlap, the first `distance` bytes are repeated. The length of the copied piece then doubles
// with every step.
void copy_match(std::byte* to, std::size_t distance, std::size_t length) {
  const std::byte* from = to - distance;
  // Entire blocks are copied, which is faster than copying the exact length. Up to kSlack bytes
  // after the copy are overwritten.
  if (distance >= 16) {
    for (std::size_t k = 0; k < length; k += 16) std::memcpy(to + k, from + k, 16);
    return;
  }
  while (length > distance) {
    std::memcpy(to, from, distance);
    to += distance;
    length -= distance;
    distance *= 2;
  }
  std::memcpy(to, from, length);
}

std::size_t hash_of(const std::byte* at) {
  const std::uint32_t bytes = std::to_integer<std::uint32_t>(at[0]) << 16 |
                              std::to_integer<std::uint32_t>(at[1]) << 8 |
                              std::to_integer<std::uint32_t>(at[2]);
  return bytes * 2654435761U >> (32 - kHashBits);
}

void put_literals(std::vector<std::byte>& out, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const std::size_t run = std::min(bytes.size(), kMaxLiterals);
    out.push_back(static_cast<std::byte>(run - 1));
    out.insert(out.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(run));
    bytes = bytes.subspan(run);
  }
}

}  // namespace

LzfFault lzf_decompress(std::span<const std::byte> in, std::size_t size, const LzfSink& sink) {
  // The window contains the recent output, to which matches refer, followed by the next output.
  // Both parts fit into the second-level cache.
  std::vector<std::byte> window(kMaxDistance + kPiece + kMaxMatch + kSlack);
  std::byte* const out = window.data();
  const std::size_t full = kMaxDistance + kPiece;
  std::size_t i = 0;     // the next byte of `in`
  std::size_t o = 0;     // the next byte of the window
  std::size_t sent = 0;  // the number of bytes of the window that the sink has received
  std::size_t left = size;
  const auto fault = [&](const char* reason) { return LzfFault{reason, i}; };
  while (i < in.size()) {
    if (o >= full) {
      sink({out + sent, o - sent});
      std::memmove(out, out + o - kMaxDistance, kMaxDistance);
      o = sent = kMaxDistance;
    }
    const auto control = std::to_integer<std::size_t>(in[i]);
    if (control < kMaxLiterals) {
      const std::size_t run = control + 1;
      if (run > in.size() - i - 1) return fault("literals that end after the data");
      if (run > left) return fault("more data than declared");
      std::memcpy(out + o, in.data() + i + 1, in.size() - i > kSlack ? kSlack : run);
      i += 1 + run;
      o += run;
      left -= run;
      continue;
    }
    std::size_t length = (control >> 5) + 2;
    const std::size_t bytes = length == 9 ? 3 : 2;
    if (bytes > in.size() - i) return fault("a match that ends after the data");
    if (bytes == 3) length += std::to_integer<std::size_t>(in[i + 1]);
    const std::size_t distance =
        ((control & 31) << 8 | std::to_integer<std::size_t>(in[i + bytes - 1])) + 1;
    if (distance > o) return fault("a match that starts before the data");
    if (length > left) return fault("more data than declared");
    copy_match(out + o, distance, length);
    i += bytes;
    o += length;
    left -= length;
  }
  if (left != 0) return fault("less data than declared");
  if (o > sent) sink({out + sent, o - sent});
  return {};
}

std::vector<std::byte> lzf_compress(std::span<const std::byte> in) {
  std::vector<std::byte> out;
  out.reserve(in.size() / 2 + 64);
  // The newest position of each hash, or SIZE_MAX if the hash has not occurred.
  std::vector<std::size_t> last(std::size_t{1} << kHashBits, SIZE_MAX);
  // `literals` is the start of the bytes that are not written yet.
  std::size_t i = 0, literals = 0;
  while (i + 3 <= in.size()) {
    std::size_t& slot = last[hash_of(in.data() + i)];
    const std::size_t candidate = slot;
    slot = i;
    if (candidate == SIZE_MAX || i - candidate > kMaxDistance ||
        std::memcmp(in.data() + candidate, in.data() + i, 3) != 0) {
      ++i;
      continue;
    }
    const std::size_t most = std::min(kMaxMatch, in.size() - i);
    std::size_t length = 3;
    while (length < most && in[candidate + length] == in[i + length]) ++length;
    put_literals(out, in.subspan(literals, i - literals));
    const std::size_t distance = i - candidate - 1;
    const std::size_t code = length - 2;
    out.push_back(static_cast<std::byte>(std::min<std::size_t>(code, 7) << 5 | distance >> 8));
    if (code >= 7) out.push_back(static_cast<std::byte>(code - 7));
    out.push_back(static_cast<std::byte>(distance & 0xFF));
    const std::size_t end = i + length;
    for (++i; i < end && i + 3 <= in.size(); ++i) last[hash_of(in.data() + i)] = i;
    i = literals = end;
  }
  put_literals(out, in.subspan(literals));
  return out;
}

}  // namespace ph::detail
