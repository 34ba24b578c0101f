// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/run/session.hpp"
#include "ph/barcode.hpp"
#include "ph/detail/io/reader.hpp"

namespace ph::app {

/// The inputs, with the barcode files of folders in place of these, by name.
/// @param others extensions of files that are taken, too, with their dot: ".png".
/// @throws Error (no_input) on a folder without any.
std::vector<std::string> barcode_files(const std::vector<std::string>& inputs,
                                       std::span<const std::string_view> others = {});

/// Opens an input; no progress is drawn while it is typed. @throws Error as Input::open.
Input open_input(const std::string& path, Session& session,
                 Input::Excess excess = Input::Excess::refused);

/// Barcodes that were read: what they take is counted as long as this lives.
class StoredBarcodes {
 public:
  /// @throws Error as open_input and read_barcode; Error (resource) if they do not fit.
  StoredBarcodes(const std::vector<std::string>& paths, Session& session);

  const std::vector<Barcode>& all() const { return barcodes_; }

 private:
  std::vector<Barcode> barcodes_;
  MemoryClaim claim_;
};

}  // namespace ph::app
