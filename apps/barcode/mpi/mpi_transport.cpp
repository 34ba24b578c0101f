// SPDX-License-Identifier: MIT
#include "apps/barcode/mpi/mpi_transport.hpp"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <thread>

namespace ph::barcode {
namespace {

constexpr int kTag = 1;
// Counts in MPI are ints. A message is therefore sent in pieces of at most this many bytes.
constexpr std::size_t kMostAtOnce = std::size_t{1} << 30;

/// Waits for a pending operation, and sleeps between polls for longer and longer times. A wait
/// inside MPI would use a whole core, which another rank may need.
void wait_for(MPI_Request& request) {
  using std::chrono::microseconds;
  constexpr int kBusy = 200;  // number of immediate polls
  constexpr microseconds kMost(200);
  int is_done = 0;
  for (int i = 0; i < kBusy && is_done == 0; ++i) MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
  for (microseconds pause(20); is_done == 0; pause = std::min(2 * pause, kMost)) {
    std::this_thread::sleep_for(pause);
    MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
  }
}

void send_piece(const void* data, std::size_t bytes, int to) {
  MPI_Request request;
  MPI_Isend(data, static_cast<int>(bytes), MPI_BYTE, to, kTag, MPI_COMM_WORLD, &request);
  wait_for(request);
}
void receive_piece(void* data, std::size_t bytes, int from) {
  MPI_Request request;
  MPI_Irecv(data, static_cast<int>(bytes), MPI_BYTE, from, kTag, MPI_COMM_WORLD, &request);
  wait_for(request);
}

}  // namespace

MpiTransport::MpiTransport(int* argc, char*** argv) {
  int provided = 0;
  MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  MPI_Comm here = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &here);
  MPI_Comm_size(here, &ranks_here_);
  MPI_Comm_free(&here);
}

void MpiTransport::send(int to, std::span<const std::byte> message) {
  const std::uint64_t size = message.size();
  send_piece(&size, sizeof(size), to);
  for (std::size_t at = 0; at < message.size(); at += kMostAtOnce) {
    const auto piece = message.subspan(at, std::min(kMostAtOnce, message.size() - at));
    send_piece(piece.data(), piece.size(), to);
  }
}

std::vector<std::byte> MpiTransport::receive(int from) {
  std::uint64_t size = 0;
  receive_piece(&size, sizeof(size), from);
  std::vector<std::byte> message(static_cast<std::size_t>(size));
  for (std::size_t at = 0; at < message.size(); at += kMostAtOnce)
    receive_piece(message.data() + at, std::min(kMostAtOnce, message.size() - at), from);
  return message;
}

void MpiTransport::wait_for_all() {
  MPI_Request request;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  wait_for(request);
}

int MpiTransport::finish(int code) {
  if (code != 0) {
    // The pause gives MPICH time to forward the output of this rank, because an abort cuts off the
    // output that is still in MPICH's pipes.
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    MPI_Abort(MPI_COMM_WORLD, code);
  }
  MPI_Finalize();
  return code;
}

}  // namespace ph::barcode
