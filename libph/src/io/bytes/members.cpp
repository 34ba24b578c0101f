// SPDX-License-Identifier: MIT
// The parts of a file that are chosen by a name, as in "FILE.npz:NAME".
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/core/files.hpp"

namespace ph {

std::pair<std::filesystem::path, std::string> split_member(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code ignored;
  for (const std::string_view suffix : {".npz:", ".ply:", ".vti:"}) {
    const std::size_t mark = name.rfind(suffix);
    if (mark == std::string::npos || std::filesystem::exists(path, ignored)) continue;
    return {files::path_of(name.substr(0, mark + suffix.size() - 1)),
            name.substr(mark + suffix.size())};
  }
  return {path, {}};
}

void detail::refuse_members(const Input& input, std::vector<std::string> names,
                            std::string_view whole) {
  constexpr std::size_t kShown = 10;
  const std::size_t count = names.size();
  if (count == 0) input.fail({fmt::format("no arrays in {}", whole), "none", "one", {}});
  if (count > kShown) {
    names.resize(kShown);
    names.push_back("...");
  }
  const std::string list = fmt::format("{}", fmt::join(names, ", "));
  if (input.member().empty())
    input.fail({fmt::format("several arrays in {}", whole), fmt::format("{} ({})", count, list),
                "one", fmt::format("choose one, for example {}:{}", input.name(), names.front())});
  input.fail({fmt::format("no such array in {}", whole),
              printable(input.member(), 40),
              "one of " + list,
              {}});
}

}  // namespace ph
