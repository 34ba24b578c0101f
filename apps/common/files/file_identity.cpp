// SPDX-License-Identifier: MIT
#include "apps/common/files/file_identity.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "apps/common/system/process.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/io/further_files.hpp"
#include "ph/detail/io/reader.hpp"
#include "ph/error.hpp"

namespace ph::app {
namespace {

namespace fs = std::filesystem;

/// The harm that results from two uses of one file. Either its contents are lost, or the outputs of
/// two writers are mixed. A pipe or a terminal has no contents to lose, but outputs can be mixed
/// there.
enum class Harm { lost, mixed };

bool is_null_device(const files::Status& status) {
  const auto null = files::status_of(fs::path("/dev/null"));
  return null && null->device == status.device && null->inode == status.inode;
}

std::optional<FileIdentity> identity(const std::optional<files::Status>& status, Harm harm) {
  if (!status || status->kind == files::Kind::folder) return std::nullopt;
  const bool keeps = status->kind == files::Kind::regular;
  // Some systems give devices no number by which they could be told apart.
  // mutant: output-pipes
  const bool mixes = harm == Harm::mixed && status->inode != 0 && !is_null_device(*status);
  if (!keeps && !mixes) return std::nullopt;
  return FileIdentity{status->device, status->inode, {}};
}

std::optional<FileIdentity> identity_of(const std::string& path, int standard_descriptor,
                                        Harm harm) {
  if (path == "-") return identity(files::status_of(standard_descriptor), harm);
  if (const auto status = files::status_of(files::path_of(path))) return identity(status, harm);
  std::error_code error;
  const fs::path absolute = fs::absolute(files::path_of(path), error);
  const fs::path place = fs::weakly_canonical(absolute, error);
  if (error) return std::nullopt;
  // A batch creates folders later. The file is therefore identified by the nearest folder that
  // exists.
  fs::path folder = place.parent_path();
  auto status = files::status_of(folder);
  while (!status) {
    if (folder == folder.parent_path()) return std::nullopt;  // mutant: file-folder
    folder = folder.parent_path();
    status = files::status_of(folder);
  }
  return FileIdentity{status->device, status->inode, place.lexically_relative(folder).string()};
}

}  // namespace

void InputFiles::add(const std::string& path, Format format) {
  if (path.empty()) return;
  add_file(path);
  // mutant: file-further
  for (const fs::path& file : detail::further_files(files::path_of(path), format))
    add_file(file.string());
}

void InputFiles::add_file(const std::string& path) {
  // mutant: file-in-archive
  const std::string whole = split_member(files::path_of(path)).first.string();
  if (auto file = identity_of(whole, files::kStandardInput, Harm::lost); file && file->name.empty())
    paths_.emplace(std::move(*file), path);
}

const std::string* InputFiles::replaced_by(const std::string& output) const {
  const auto file = identity_of(output, files::kStandardOutput, Harm::lost);
  if (!file) return nullptr;
  const auto input = paths_.find(*file);
  return input == paths_.end() ? nullptr : &input->second;
}

void InputFiles::require_other(const Written& output) const {
  const std::string* input = replaced_by(output.path);
  if (!input) return;
  const auto named = [](const std::string& path, std::string_view standard) {
    return path == "-" ? std::string(standard) : printable(path);
  };
  const std::string in = named(*input, "standard input"),
                    out = named(output.path, "standard output");
  throw Error(
      ErrorKind::usage,
      fmt::format("{}: {} is {}, expected a file that is not an input; --force writes over it",
                  output.option, out,
                  in == out ? std::string("an input") : fmt::format("the input {}", in)));
}

std::string require_given(std::string_view option, const std::string& path) {
  const auto descriptor = files::descriptor_named(files::path_of(path));
  if (!descriptor || is_given(*descriptor)) return path;
  throw Error(
      ErrorKind::usage,
      fmt::format("{}: found {}, expected a descriptor that is open when the program starts",
                  option, printable(path)));
}

void require_distinct(std::span<const Written> outputs) {
  std::map<FileIdentity, const Written*> files;
  const Written* standard = nullptr;
  const auto reject = [](const Written& one, const Written& other) {
    throw Error(
        ErrorKind::usage,
        fmt::format("{}: {} is also written by {}; expected a file for each", one.option,
                    one.path == "-" ? "standard output" : printable(one.path), other.option));
  };
  for (const Written& output : outputs) {
    // Two outputs on standard output are refused, regardless of what standard output is connected
    // to.
    if (output.path == "-") {
      if (standard) reject(output, *standard);
      standard = &output;
    }
    auto file = identity_of(output.path, files::kStandardOutput, Harm::mixed);
    if (!file) continue;
    const auto [other, is_new] = files.emplace(std::move(*file), &output);
    if (!is_new) reject(output, *other->second);
  }
}

bool require_separate(const InputFiles& inputs, std::span<const Written> outputs, bool force) {
  require_distinct(outputs);
  bool replaces = false;
  for (const Written& output : outputs) {
    if (!force) inputs.require_other(output);  // mutant: file-overwrite
    replaces = replaces || inputs.replaced_by(output.path) != nullptr;
  }
  return replaces;
}

}  // namespace ph::app
