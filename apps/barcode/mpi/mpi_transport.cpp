// SPDX-License-Identifier: MIT
#include "barcode/mpi/mpi_transport.hpp"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <thread>

namespace ph::barcode {
namespace {

constexpr int kTag = 1;
// Counts of MPI are ints: a message goes in pieces of at most so many bytes.
constexpr std::size_t kMostAtOnce = std::size_t{1} << 30;

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
  MPI_Send(&size, 1, MPI_UINT64_T, to, kTag, MPI_COMM_WORLD);
  for (std::size_t at = 0; at < message.size(); at += kMostAtOnce) {
    const auto piece = message.subspan(at, std::min(kMostAtOnce, message.size() - at));
    MPI_Send(piece.data(), static_cast<int>(piece.size()), MPI_BYTE, to, kTag, MPI_COMM_WORLD);
  }
}

std::vector<std::byte> MpiTransport::receive(int from) {
  std::uint64_t size = 0;
  MPI_Recv(&size, 1, MPI_UINT64_T, from, kTag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  std::vector<std::byte> message(static_cast<std::size_t>(size));
  for (std::size_t at = 0; at < message.size(); at += kMostAtOnce) {
    const std::size_t piece = std::min(kMostAtOnce, message.size() - at);
    MPI_Recv(message.data() + at, static_cast<int>(piece), MPI_BYTE, from, kTag, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
  }
  return message;
}

void MpiTransport::wait_for_all() { MPI_Barrier(MPI_COMM_WORLD); }

int MpiTransport::finish(int code) {
  if (code != 0) {
    // What was said goes through MPICH's own pipes, which an abort cuts.
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    MPI_Abort(MPI_COMM_WORLD, code);
  }
  MPI_Finalize();
  return code;
}

}  // namespace ph::barcode
