// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace ph {

/// The communication between the ranks of one computation: processes under MPI, or threads in a
/// test. Only one thread of a rank may use it at a time.
class Transport {
 public:
  Transport() = default;
  virtual ~Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  virtual int rank() const = 0;  ///< counted from 0
  virtual int size() const = 0;  ///< number of ranks
  /// Sends a message to the rank `to`; may return before that rank has received it.
  virtual void send(int to, std::span<const std::byte> message) = 0;
  /// Waits for the next message from that rank.
  virtual std::vector<std::byte> receive(int from) = 0;
};

}  // namespace ph
