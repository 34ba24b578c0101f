// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "facade/parts/transport.hpp"

namespace ph {

/// Messages between ranks with a number and a checksum: one that is lost, comes twice, in another
/// order, or changed on its way is an error, and no wrong answer.
class Post {
 public:
  explicit Post(Transport& transport) : transport_(transport), sent_(ranks()), received_(ranks()) {}

  int rank() const { return transport_.rank(); }
  int size() const { return transport_.size(); }
  void send(int to, std::span<const std::byte> message);
  /// @throws Error (io) that says which message was expected and which one came.
  std::vector<std::byte> receive(int from);
  /// All that this rank has sent, in bytes.
  std::uint64_t bytes_sent() const { return bytes_sent_; }

 private:
  std::size_t ranks() const { return static_cast<std::size_t>(transport_.size()); }

  Transport& transport_;
  std::vector<std::uint64_t> sent_, received_;  // how many, by rank
  std::uint64_t bytes_sent_ = 0;
};

}  // namespace ph
