// SPDX-License-Identifier: MIT
#pragma once
#include "ph/detail/facade/transport.hpp"

namespace ph::barcode {

/// The MPI ranks. At most one such object exists, and it lives as long as the program uses MPI.
/// Only the thread that made it uses it (MPI_THREAD_FUNNELED). A failure of MPI ends all ranks.
class MpiTransport final : public Transport {
 public:
  MpiTransport(int* argc, char*** argv);

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void send(int to, std::span<const std::byte> message) override;
  std::vector<std::byte> receive(int from) override;
  /// The number of ranks on this machine, which share its memory and cores.
  int ranks_here() const { return ranks_here_; }
  /// Waits until all ranks have called this function.
  void wait_for_all();
  /// Ends this rank, and also all other ranks unless the code is 0. @return the code.
  int finish(int code);

 private:
  int rank_ = 0, size_ = 1, ranks_here_ = 1;
};

}  // namespace ph::barcode
