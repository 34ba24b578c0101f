// SPDX-License-Identifier: MIT
#include "ph/detail/facade/post.hpp"

#include <fmt/format.h>

#include "libph/src/core/bytes/crc32.hpp"
#include "ph/detail/core/byte_reader.hpp"
#include "ph/detail/core/byte_writer.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

constexpr std::size_t kNumberSize = 8, kChecksumSize = 4;

}  // namespace

void Post::send(int to, std::span<const std::byte> message) {
  ByteWriter writer;
  writer.put(sent_[static_cast<std::size_t>(to)]++);
  std::vector<std::byte> bytes = writer.take();
  bytes.reserve(kNumberSize + message.size() + kChecksumSize);
  bytes.insert(bytes.end(), message.begin(), message.end());
  ByteWriter checksum;
  checksum.put(crc32(bytes));
  const std::vector<std::byte> end = checksum.take();
  bytes.insert(bytes.end(), end.begin(), end.end());
  bytes_sent_ += bytes.size();
  transport_.send(to, bytes);
}

std::vector<std::byte> Post::receive(int from) {
  std::vector<std::byte> bytes = transport_.receive(from);
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::io,
                fmt::format("rank {}: message from rank {}: {}", rank(), from, what));
  };
  if (bytes.size() < kNumberSize + kChecksumSize)
    refuse(fmt::format("found {} bytes, expected {} or more", bytes.size(),
                       kNumberSize + kChecksumSize));
  const std::span<const std::byte> all(bytes);
  const auto expected_checksum =
      ByteReader(all.last(kChecksumSize), "message").get<std::uint32_t>("checksum");
  // mutant: message-checksum
  if (crc32(all.first(all.size() - kChecksumSize)) != expected_checksum)
    refuse("found a checksum that differs from the one sent: the message is damaged");
  const auto number = ByteReader(all.first(kNumberSize), "message").get<std::uint64_t>("number");
  const std::uint64_t expected = received_[static_cast<std::size_t>(from)]++;
  if (number != expected)  // mutant: message-order
    refuse(fmt::format("found number {}, expected {}: a message was lost, repeated or sent early",
                       number, expected));
  bytes.resize(bytes.size() - kChecksumSize);
  bytes.erase(bytes.begin(), bytes.begin() + kNumberSize);
  return bytes;
}

}  // namespace ph
