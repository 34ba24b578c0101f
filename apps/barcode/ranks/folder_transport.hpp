// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "barcode/ranks/run_folder.hpp"
#include "facade/parts/transport.hpp"

namespace ph::barcode {

/// Ranks that send each other files: part-TO/FROM-NUMBER in the folder of the run. Precondition of
/// send and receive: the folder was joined.
class FolderTransport final : public Transport {
 public:
  explicit FolderTransport(RunFolder& run);

  int rank() const override { return run_.rank(); }
  int size() const override { return run_.size(); }
  std::string_view word() const override { return "part"; }
  std::string name_of(int rank) const override;
  /// @throws Error (io), as RunFolder::check.
  void send(int to, std::span<const std::byte> message) override;
  std::vector<std::byte> receive(int from) override;

 private:
  RunFolder& run_;
  std::vector<std::uint64_t> sent_, received_;  // how many, by rank
};

}  // namespace ph::barcode
