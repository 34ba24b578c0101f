// SPDX-License-Identifier: MIT
#include "ph/detail/report/sha256.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace ph::report {
namespace {

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

}  // namespace

void Sha256::add(std::span<const std::byte> bytes, Ticker& ticker) {
  const std::size_t waiting = bytes_ % kBlock;
  bytes_ += bytes.size();
  if (waiting > 0) {
    const std::size_t taken = std::min(kBlock - waiting, bytes.size());
    std::ranges::copy(bytes.first(taken), rest_.begin() + static_cast<std::ptrdiff_t>(waiting));
    bytes = bytes.subspan(taken);
    if (waiting + taken < kBlock) return;
    add_block(state_, rest_.data());
  }
  for (; bytes.size() >= kBlock; bytes = bytes.subspan(kBlock)) {
    add_block(state_, bytes.data());
    ticker.tick();
  }
  std::ranges::copy(bytes, rest_.begin());
}

void Sha256::add(std::span<const std::byte> bytes) {
  Ticker ticker(context_, "hash", bytes.size() / kBlock);
  add(bytes, ticker);
}

void Sha256::add(const Input& input) {
  constexpr std::size_t part = std::size_t{1} << 20;
  Ticker ticker(context_, "hash", input.size() / kBlock);
  for (std::size_t begin = 0; begin < input.size(); begin += part) {
    const std::size_t size = std::min(part, input.size() - begin);
    add(input.bytes().subspan(begin, size), ticker);
    input.done_with(begin, size);  // mutant: report-sha256
  }
}

std::string Sha256::hex() const {
  // The padding consists of a one, zeros, and the length in the last eight bytes.
  State state = state_;
  std::array<std::byte, 2 * kBlock> last{};
  const std::size_t waiting = bytes_ % kBlock;
  std::copy_n(rest_.begin(), waiting, last.begin());
  last[waiting] = std::byte{0x80};
  const std::size_t end = waiting + 9 <= kBlock ? kBlock : 2 * kBlock;
  for (std::size_t k = 0; k < 8; ++k)
    last[end - 1 - k] = static_cast<std::byte>(8 * bytes_ >> 8 * k);
  for (std::size_t k = 0; k < end; k += kBlock) add_block(state, last.data() + k);
  std::string text;
  for (const std::uint32_t word : state) text += fmt::format("{:08x}", word);
  return text;
}

std::string sha256_hex(const Input& input, const RunContext& context) {
  Sha256 hash(context);
  hash.add(input);
  return hash.hex();
}

}  // namespace ph::report
