// SPDX-License-Identifier: MIT
#include "apps/common/inputs/barcode_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <optional>

#include "apps/common/files/batch_names.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/io/table.hpp"

namespace ph::app {
namespace {

constexpr std::array<std::string_view, 7> kBarcodes{".csv",   ".json",    ".ripser", ".pers",
                                                    ".dipha", ".diagram", ".npy"};

/// The settings that affect the bars of an input. The threshold is left out, because it differs
/// between inputs. The value of a setting that the file does not state is empty.
std::vector<std::pair<std::string_view, std::string>> ways_of(const BarcodeInfo& info) {
  const auto flag = [](bool is_set) { return std::string(is_set ? "true" : "false"); };
  const auto numbers = [](const std::vector<int>& all) {
    return all.empty() ? "none" : fmt::format("{}", fmt::join(all, ", "));
  };
  return {{"complex", info.complex},
          {"metric", info.metric},
          {"construction", info.construction},
          {"periodic axes", info.construction.empty() ? "" : numbers(info.periodic)},
          {"field", std::to_string(info.field)},
          {"max_dim", std::to_string(info.max_dim)},
          {"min_persistence", info.min_persistence ? shortest(*info.min_persistence) : ""},
          {"min_dim", std::to_string(info.min_dim)},
          {"superlevel", flag(info.superlevel)},
          {"squared", flag(info.alpha && info.alpha->squared)},
          {"approximation", info.approximation ? shortest(*info.approximation) : "none"}};
}

}  // namespace

void SameOrigin::add(const std::string& name, const BarcodeInfo& info) {
  if (info.complex.empty() || is_told_) return;
  const auto ways = ways_of(info);
  if (first_name_.empty()) {
    first_name_ = name;
    first_ = ways;
    return;
  }
  std::vector<std::string> differences;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const auto& [what, way] = ways[i];
    const std::string& first = first_[i].second;
    if (!way.empty() && !first.empty() && way != first)
      differences.push_back(fmt::format("{} {}, not {}", what, way, first));
  }
  if (differences.empty()) return;
  is_told_ = true;
  session_.note(fmt::format("{} was not computed in the same way as {}: {}", printable(name),
                            printable(first_name_), fmt::join(differences, "; ")));
}

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
  return Input::open(path, &session.context(), excess, detail::start_check());
}

StoredBarcodes::StoredBarcodes(const std::vector<std::string>& paths, Session& session)
    : claim_(session.context().memory, 0) {
  std::size_t bytes = 0;
  SameOrigin origin(session);
  for (const std::string& path : paths) {
    const Input input = open_input(path, session);
    StoredBarcode stored = read_stored_barcode(input);
    origin.add(path, stored.bars.info());
    barcodes_.push_back(std::move(stored.bars));
    session.explain(
        fmt::format("read {}: {}", input.name(), count_of(barcodes_.back().size(), "bar")));
    bytes += barcodes_.back().bytes();
    claim_.grow_to(bytes);
  }
}

}  // namespace ph::app
