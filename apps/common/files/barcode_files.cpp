// SPDX-License-Identifier: MIT
#include "common/files/barcode_files.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "common/arguments/numbers.hpp"
#include "common/files/batch_names.hpp"
#include "ph/io/write.hpp"

namespace ph::app {
namespace {

constexpr std::array<std::string_view, 7> kBarcodes{".csv",   ".json",    ".ripser", ".pers",
                                                    ".dipha", ".diagram", ".npy"};

}  // namespace

std::vector<std::string> barcode_files(const std::vector<std::string>& inputs,
                                       std::span<const std::string_view> others) {
  std::vector<std::string> extensions(kBarcodes.begin(), kBarcodes.end());
  extensions.insert(extensions.end(), others.begin(), others.end());
  const std::size_t plain = extensions.size();
  for (std::size_t i = 0; i < plain; ++i) extensions.push_back(extensions[i] + ".gz");
  const std::vector<std::string_view> views(extensions.begin(), extensions.end());
  std::vector<std::string> files;
  for (const std::string& input : inputs) {
    if (!is_folder(input)) {
      files.push_back(input);
      continue;
    }
    for (std::string& file : files_in(input, views, "a file of a known format"))
      files.push_back(std::move(file));
  }
  return files;
}

Input open_input(const std::string& path, Session& session, Input::Excess excess) {
  std::optional<BarHold> somebody_types;
  if (is_typed({path})) somebody_types.emplace(session);
  return Input::open(path, &session.context(), excess);
}

StoredBarcodes::StoredBarcodes(const std::vector<std::string>& paths, Session& session)
    : claim_(session.context().memory, 0) {
  std::size_t bytes = 0;
  for (const std::string& path : paths) {
    const Input input = open_input(path, session);
    barcodes_.push_back(read_barcode(input));
    session.explain(
        fmt::format("read {}: {}", input.name(), count_of(barcodes_.back().size(), "bar")));
    bytes += barcodes_.back().bytes();
    claim_.grow_to(bytes);
  }
}

}  // namespace ph::app
