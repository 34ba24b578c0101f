// SPDX-License-Identifier: MIT
#include "apps/distance/data/groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "apps/common/values/numbers.hpp"

namespace ph::distance_program {

Groups read_groups(const Input& input, std::size_t count) {
  Groups groups;
  std::map<std::string, std::size_t, std::less<>> places;
  TextLines lines(input);
  while (lines.next()) {
    const std::string_view word = lines.line();
    // mutant: group-first-word
    if (const auto gap = std::ranges::find_if(
            word, [](char c) { return c == ' ' || c == '\t' || c == ',' || c == ';'; });
        gap != word.end())
      lines.fail(
          &*gap,
          {"a group", fmt::format("\"{}\"", printable(word, 40)), "one word on each line", {}});
    const auto [place, is_new] = places.try_emplace(std::string(word), groups.names.size());
    if (is_new) {
      groups.names.push_back(printable(word));
      groups.sizes.push_back(0);
    }
    ++groups.sizes[place->second];
    groups.of.push_back(static_cast<std::int64_t>(place->second));
  }
  if (groups.of.size() != count)  // mutant: group-words
    input.fail({"groups",
                app::count_of(groups.of.size(), "word"),
                fmt::format("{}, one for each barcode, in the order of the barcodes", count),
                {}});
  if (groups.names.size() < 2)
    input.fail({"groups", app::count_of(groups.names.size(), "group"), "at least 2", {}});
  for (std::size_t g = 0; g < groups.names.size(); ++g)
    if (groups.sizes[g] < 2)
      input.fail({"group " + groups.names[g], "1 barcode", "at least 2 in each group", {}});
  return groups;
}

std::string words_of(const Groups& groups) {
  std::string words;
  for (std::size_t g = 0; g < groups.names.size(); ++g)
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", groups.names[g], groups.sizes[g]);
  return words;
}

}  // namespace ph::distance_program
