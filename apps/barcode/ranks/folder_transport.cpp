// SPDX-License-Identifier: MIT
#include "barcode/ranks/folder_transport.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "core/system/files.hpp"
#include "ph/error.hpp"

namespace ph::barcode {
namespace {

namespace fs = std::filesystem;

/// Whether a file is in a folder. The folder is read anew: a file system of a network may remember
/// for a minute that a name was not there.
bool is_in(const fs::path& folder, const std::string& name) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->path().filename() == name) return true;
  return false;
}

/// Nothing: it cannot be read.
std::optional<std::vector<std::byte>> bytes_of(const fs::path& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  std::ifstream from(path, std::ios::binary);
  if (error || !from) return std::nullopt;
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  from.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!from) return std::nullopt;
  return bytes;
}

}  // namespace

FolderTransport::FolderTransport(RunFolder& run)
    : run_(run),
      sent_(static_cast<std::size_t>(run.size())),
      received_(static_cast<std::size_t>(run.size())) {}

std::string FolderTransport::name_of(int rank) const { return fmt::format("part {}", rank + 1); }

void FolderTransport::send(int to, std::span<const std::byte> message) {
  run_.check();
  const fs::path folder = run_.messages_to(to);
  const fs::path unfinished = folder / fmt::format("{}.new", rank() + 1);
  std::ofstream file(unfinished, std::ios::binary);
  file.write(reinterpret_cast<const char*>(message.data()),
             static_cast<std::streamsize>(message.size()));
  file.close();
  const std::uint64_t number = sent_[static_cast<std::size_t>(to)]++;
  if (!file || !files::rename(unfinished, folder / fmt::format("{}-{}", rank() + 1, number)))
    throw Error(ErrorKind::io,
                fmt::format("--exchange: a message to part {}: cannot be written", to + 1));
}

std::vector<std::byte> FolderTransport::receive(int from) {
  const std::string name =
      fmt::format("{}-{}", from + 1, received_[static_cast<std::size_t>(from)]++);
  const fs::path folder = run_.messages_to(rank()), path = folder / name;
  constexpr int tries = 50;  // in some seconds; a scanner of viruses may have it for a moment
  int failures = 0;
  auto message = run_.wait_for([&] {
    std::optional<std::vector<std::byte>> bytes;
    if (!is_in(folder, name)) return bytes;
    bytes = bytes_of(path);
    if (!bytes && ++failures == tries)
      throw Error(ErrorKind::io,
                  fmt::format("--exchange: a message from part {}: cannot be read", from + 1));
    return bytes;
  });
  files::remove(path);
  return std::move(*message);
}

}  // namespace ph::barcode
