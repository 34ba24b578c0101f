// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace ph {

/// How the ranks of one computation talk: processes under MPI, or threads in a test. A rank uses it
/// from one thread at a time.
class Transport {
 public:
  Transport() = default;
  virtual ~Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  virtual int rank() const = 0;  ///< from 0 on
  virtual int size() const = 0;  ///< how many ranks there are
  /// May return before the other one has the message.
  virtual void send(int to, std::span<const std::byte> message) = 0;
  /// The next message from that rank; waits for it.
  virtual std::vector<std::byte> receive(int from) = 0;
};

}  // namespace ph
