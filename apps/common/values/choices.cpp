// SPDX-License-Identifier: MIT
#include "apps/common/values/choices.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "ph/error.hpp"

namespace ph::app {
namespace {

/// The least number of single-character edits and swaps of neighbours that turn a into b (optimal
/// string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = row;
  }
  return last[b.size()];
}

/// True if one name has a word where the other one has its opposite.
bool are_opposites(std::string_view a, std::string_view b) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kPairs{
      {{"min", "max"}, {"lower", "upper"}, {"sub", "super"}, {"birth", "death"}}};
  const auto has = [](std::string_view name, std::string_view word) {
    return name.find(word) != name.npos;
  };
  return std::ranges::any_of(kPairs, [&](const auto& pair) {
    const auto& [x, y] = pair;
    return (has(a, x) && has(b, y) && !has(b, x)) || (has(a, y) && has(b, x) && !has(b, y));
  });
}

}  // namespace

std::optional<std::string_view> nearest_name(std::string_view typed,
                                             std::span<const std::string_view> names) {
  // A longer word is not a mistyped name. The limit also bounds the cost of the search.
  constexpr std::size_t kLongestWord = 64;
  if (typed.empty() || typed.size() > kLongestWord) return std::nullopt;
  const auto word_of = [](std::string_view name) {
    return name.substr(std::min(name.find_first_not_of('-'), name.size()));
  };
  const std::string_view word = word_of(typed);
  std::optional<std::string_view> best;
  std::size_t best_distance = 0;
  for (const std::string_view name : names) {
    // A beginning or an end of a name ("--max" for "--max-dim") counts as one edit. An extra word
    // before an option's name ("--plot-title" for "--title") also counts as one edit.
    const std::string_view known = word_of(name);
    if (are_opposites(word, known)) continue;
    const bool part = (word.size() >= 3 && (known.starts_with(word) || known.ends_with(word))) ||
                      (name.starts_with("--") && word.size() > known.size() + 1 &&
                       word.ends_with(known) && word[word.size() - known.size() - 1] == '-');
    const std::size_t distance = part ? 1 : edit_distance(word, known);
    if (!best || distance < best_distance) {
      best = name;
      best_distance = distance;
    }
  }
  // One edit is allowed, or two edits in a word of at least six letters.
  const std::size_t enough = std::clamp<std::size_t>(word.size() / 3, 1, 2);  // mutant: hint-far
  if (best_distance > enough) return std::nullopt;
  return best;
}

std::size_t choose(std::string_view option, std::string_view word,
                   std::span<const std::string_view> choices) {
  const auto found = std::ranges::find(choices, word);
  if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  const auto near = nearest_name(word, choices);
  throw Error(
      ErrorKind::usage,
      fmt::format("{}: found '{}', expected one of {}{}", option, word, fmt::join(choices, ", "),
                  near ? fmt::format("; did you mean '{}'?", *near) : ""));
}

}  // namespace ph::app
