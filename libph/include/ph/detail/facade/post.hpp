// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ph/detail/facade/transport.hpp"

namespace ph {

/// Sends messages with a number and a checksum between ranks. If a message is lost, repeated, out
/// of order or damaged, the result is an error instead of a wrong answer.
class Post {
 public:
  explicit Post(Transport& transport) : transport_(transport), sent_(ranks()), received_(ranks()) {}

  int rank() const { return transport_.rank(); }
  int size() const { return transport_.size(); }
  void send(int to, std::span<const std::byte> message);
  /// @throws Error (io) naming the message that was expected and the message that arrived.
  std::vector<std::byte> receive(int from);
  /// Number of bytes that this rank has sent.
  std::uint64_t bytes_sent() const { return bytes_sent_; }

 private:
  std::size_t ranks() const { return static_cast<std::size_t>(transport_.size()); }

  Transport& transport_;
  std::vector<std::uint64_t> sent_, received_;  // number of messages, by rank
  std::uint64_t bytes_sent_ = 0;
};

}  // namespace ph
