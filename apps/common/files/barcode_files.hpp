// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/run/session.hpp"
#include "ph/barcode.hpp"
#include "ph/detail/io/reader.hpp"
#include "ph/io/write.hpp"

namespace ph::app {

/// The inputs, with the barcode files of folders in place of these, by name.
/// @param others extensions of files that are taken, too, with their dot: ".png".
/// @throws Error (no_input) on a folder without any.
std::vector<std::string> barcode_files(const std::vector<std::string>& inputs,
                                       std::span<const std::string_view> others = {});

/// Opens an input; no progress is drawn while it is typed. @throws Error as Input::open.
Input open_input(const std::string& path, Session& session,
                 Input::Excess excess = Input::Excess::refused);

/// Whether barcodes that are compared were computed in the same way, as far as their files say it
/// (JSON does): a note says in what the first one that differs from the first of all does so.
class SameOrigin {
 public:
  explicit SameOrigin(Session& session) : session_(session) {}
  void add(const std::string& name, const BarcodeInfo& info);

 private:
  Session& session_;
  std::string first_name_;                                       // empty: none has said anything
  std::vector<std::pair<std::string_view, std::string>> first_;  // option, value
  bool is_told_ = false;
};

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
