// SPDX-License-Identifier: MIT
#include "ph/detail/report/sha256.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace ph::report {
namespace {

constexpr std::size_t kBlock = 64;  // in bytes
using State = std::array<std::uint32_t, 8>;

// These numbers of FIPS 180-4, 4.2.2, are derived from the cube roots of the first 64 primes.
constexpr std::array<std::uint32_t, 64> kRounds = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

void add_block(State& state, const std::byte* block) {
  std::array<std::uint32_t, 64> w;
  for (std::size_t i = 0; i < 16; ++i) {
    w[i] = 0;
    for (std::size_t k = 0; k < 4; ++k)
      w[i] = w[i] << 8 | std::to_integer<std::uint32_t>(block[4 * i + k]);
  }
  for (std::size_t i = 16; i < 64; ++i) {
    const std::uint32_t a = w[i - 15], b = w[i - 2];
    w[i] = w[i - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3) + w[i - 7] +
           (std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10);
  }
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t i = 0; i < 64; ++i) {
    const std::uint32_t one = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                              ((e & f) ^ (~e & g)) + kRounds[i] + w[i];
    const std::uint32_t two =
        (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g;
    g = f;
    f = e;
    e = d + one;
    d = c;
    c = b;
    b = a;
    a = one + two;
  }
  const State added = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < state.size(); ++i) state[i] += added[i];
}

/// @param done_with called as done_with(begin, size) after each part of about a MiB has been read.
template <class DoneWith>
std::string hex_of(std::span<const std::byte> bytes, const RunContext& context,
                   DoneWith&& done_with) {
  constexpr std::size_t part = std::size_t{1} << 20;  // a multiple of kBlock
  State state = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  Ticker ticker(context, "hash", bytes.size() / kBlock);
  std::size_t at = 0, given_back = 0;
  for (; bytes.size() - at >= kBlock; at += kBlock) {
    if (at - given_back == part) {
      done_with(given_back, part);
      given_back = at;
    }
    add_block(state, bytes.data() + at);
    ticker.tick();
  }
  // The padding consists of a one, zeros, and the length in the last eight bytes.
  const std::span last = bytes.subspan(at);
  const std::uint64_t bits = std::uint64_t{8} * bytes.size();
  std::array<std::byte, 2 * kBlock> rest{};
  std::ranges::copy(last, rest.begin());
  done_with(given_back, bytes.size() - given_back);
  rest[last.size()] = std::byte{0x80};
  const std::size_t end = last.size() + 9 <= kBlock ? kBlock : 2 * kBlock;
  for (std::size_t k = 0; k < 8; ++k) rest[end - 1 - k] = static_cast<std::byte>(bits >> 8 * k);
  for (std::size_t k = 0; k < end; k += kBlock) add_block(state, rest.data() + k);
  std::string text;
  for (const std::uint32_t word : state) text += fmt::format("{:08x}", word);
  return text;
}

}  // namespace

std::string sha256_hex(std::span<const std::byte> bytes, const RunContext& context) {
  return hex_of(bytes, context, [](std::size_t, std::size_t) {});
}

std::string sha256_hex(const Input& input, const RunContext& context) {
  // mutant: report-sha256
  return hex_of(input.bytes(), context,
                [&](std::size_t begin, std::size_t size) { input.done_with(begin, size); });
}

}  // namespace ph::report
