// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/common/run/session.hpp"
#include "ph/barcode.hpp"
#include "ph/detail/io/reader.hpp"
#include "ph/io/write.hpp"

namespace ph::app {

/// The inputs, with each folder replaced by its barcode files, sorted by name.
/// @param others the extensions of files that are also accepted, with their dot, such as ".png".
/// @throws Error (no_input) on a folder without such files.
std::vector<std::string> barcode_files(const std::vector<std::string>& inputs,
                                       std::span<const std::string_view> others = {});

/// Opens an input. If somebody types it at a terminal, no progress is drawn in the meantime.
/// @throws Error like Input::open.
Input open_input(const std::string& path, Session& session,
                 Input::Excess excess = Input::Excess::refused);

/// Checks that the barcodes to compare were computed in the same way, as far as their files state
/// this (JSON files state it). If the settings of a file differ from the settings of the first
/// file, a note names both files and the difference.
class SameOrigin {
 public:
  explicit SameOrigin(Session& session) : session_(session) {}
  void add(const std::string& name, const BarcodeInfo& info);

 private:
  Session& session_;
  std::string first_name_;  // empty if no file has stated any setting
  std::vector<std::pair<std::string_view, std::string>> first_;  // option, value
  bool is_told_ = false;
};

/// Barcodes that were read. Their memory is counted as long as this object lives.
class StoredBarcodes {
 public:
  /// @throws Error like open_input and read_barcode; Error (resource) if the barcodes do not fit
  /// into memory.
  StoredBarcodes(const std::vector<std::string>& paths, Session& session);

  const std::vector<Barcode>& all() const { return barcodes_; }

 private:
  std::vector<Barcode> barcodes_;
  MemoryClaim claim_;
};

}  // namespace ph::app
