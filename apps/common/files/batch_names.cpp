// SPDX-License-Identifier: MIT
#include "apps/common/files/batch_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>

#include "apps/common/files/file_identity.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/io/reader.hpp"
#include "ph/error.hpp"

namespace ph::app {
namespace {

std::string file_name(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::string name = slash == path.npos ? path : path.substr(slash + 1);
  return name == "-" ? "stdin" : name;
}

std::string stem(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == name.npos || dot == 0 ? name : name.substr(0, dot);
}

/// The file name, preceded by the names of its folders. For example, "monday/../run/a.txt" becomes
/// "monday-run-a.txt".
std::string name_with_folders(const std::string& path) {
  std::string joined;
  for (std::size_t begin = 0; begin < path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string part = path.substr(begin, end - begin);
    if (!part.empty() && part != "." && part != "..") joined += (joined.empty() ? "" : "-") + part;
    begin = end + 1;
  }
  return joined == "-" ? file_name(path) : joined;
}

}  // namespace

std::vector<std::string> output_names(const std::vector<std::string>& inputs) {
  std::map<std::string, int> stems, names;
  for (const std::string& input : inputs) {
    ++stems[stem(file_name(input))];
    ++names[file_name(input)];
  }
  std::vector<std::string> result;
  for (const std::string& input : inputs) {
    const std::string name = file_name(input), short_name = stem(name);
    result.push_back(stems[short_name] == 1 ? short_name
                     : names[name] == 1     ? name
                                            : name_with_folders(input));
  }
  return result;
}

bool names_each(const std::string& path) {
  return path.ends_with('/') || file_name(path).find('*') != path.npos;
}

std::string filled(const std::string& pattern, const std::string& name,
                   std::string_view extension) {
  if (pattern.empty()) return {};
  if (pattern.ends_with('/')) return fmt::format("{}{}{}", pattern, name, extension);
  if (!names_each(pattern)) return fmt::format("{}/{}{}", pattern, name, extension);
  std::string path = pattern;
  return path.replace(pattern.rfind('*'), 1, name);
}

void prepare_outputs(std::string_view option, const std::string& pattern) {
  if (pattern.empty() || is_folder(pattern)) return;
  const std::size_t slash = pattern.rfind('/');
  if (!names_each(pattern))
    throw Error(
        ErrorKind::usage,
        fmt::format(
            "{}: found '{}', expected a folder (FOLDER/) or a * for the names of several inputs",
            option, printable(pattern)));
  if (slash != pattern.npos && slash > 0) create_folder(pattern.substr(0, slash));
}

std::vector<std::string> files_in(const std::string& folder,
                                  std::span<const std::string_view> extensions,
                                  std::string_view what) {
  namespace fs = std::filesystem;
  const auto is_known = [&](const std::string& name) {
    return std::ranges::any_of(
        extensions, [&](std::string_view e) { return name.size() > e.size() && ends_in(name, e); });
  };
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator at(files::path_of(folder), error), end; !error && at != end;
       at.increment(error))
    if (is_known(at->path().filename().string())) files.push_back(at->path().string());
  if (error || files.empty())
    throw Error(ErrorKind::no_input,
                fmt::format("{}: {}", printable(folder),
                            error ? error.message() : fmt::format("a folder without {}", what)));
  // A link may point to a descriptor.
  for (const std::string& file : files) require_given(printable(folder), file);
  std::ranges::sort(files);
  return files;
}

bool is_folder(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_directory(files::path_of(path), error);
}

void create_folder(const std::string& path) {
  std::error_code error;
  if (std::filesystem::create_directory(files::path_of(path), error) || is_folder(path)) return;
  throw Error(ErrorKind::cannot_create,
              fmt::format("{}: cannot create the folder: {}", path, error.message()));
}

}  // namespace ph::app
