// SPDX-License-Identifier: MIT
// Interprets the cells of a table, headers, and columns that are chosen by name or by number.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/core/floating.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/io/table.hpp"

namespace ph::detail {
namespace {

constexpr std::size_t kShownNames = 10;

// True if a cell was meant as a number. The line is then not a header.
bool looks_numeric(std::string_view cell) {
  for (const std::string_view word : {"nan", "inf", "infinity"}) {
    const std::size_t sign = !cell.empty() && (cell[0] == '-' || cell[0] == '+') ? 1 : 0;
    if (std::ranges::equal(cell.substr(sign), word, {}, to_lower)) return true;
  }
  while (!cell.empty() && (cell[0] == '-' || cell[0] == '+' || cell[0] == '.')) {
    cell.remove_prefix(1);
  }
  return cell.empty() || (cell[0] >= '0' && cell[0] <= '9');
}

// The length of the first cell of a header. Separators inside quotes do not count.
std::size_t header_cell(std::string_view rest, char separator) {
  bool in_quotes = false;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i] == '"') in_quotes = !in_quotes;
    if (!in_quotes && rest[i] == separator) return i;
  }
  return rest.size();
}

}  // namespace

char separator_in(std::string_view line) {
  for (const char separator : {',', ';', '\t'})
    if (header_cell(line, separator) != line.size()) return separator;
  return ' ';
}

std::vector<std::string> header_cells(std::string_view line, bool names_only, bool keeps_tabs) {
  // CloudCompare begins a line of names in this way.
  if (line.starts_with("//")) line.remove_prefix(2);
  const char separator = separator_in(line);
  const auto trimmed = [separator](std::string_view text) {
    const auto is_blank = [&](char c) { return c == ' ' || (c == '\t' && separator != '\t'); };
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
  };
  std::vector<std::string> cells;
  bool all_missing = true;
  for (std::string_view rest = trimmed(line); !rest.empty();) {
    const std::size_t length = header_cell(rest, separator);
    const std::string_view cell = without_quotes(trimmed(rest.substr(0, length)));
    const bool is_space = length == 0 && separator == '\t' && !keeps_tabs;
    rest = trimmed(rest.substr(std::min(length + 1, rest.size())));
    if (is_space) continue;
    if (names_only && looks_numeric(cell)) return {};
    all_missing = all_missing && is_missing_value(cell);
    cells.emplace_back(cell);
  }
  if (names_only && all_missing) return {};
  return cells;
}

std::vector<std::size_t> chosen_columns(const std::vector<std::string>& wanted,
                                        const std::vector<std::string>& header, std::size_t width,
                                        const Input& input) {
  const auto fail = [&](const std::string& word, std::string_view why) {
    std::vector<std::string> names;
    for (const std::string& name : header) {
      if (names.size() == kShownNames) break;
      if (!name.empty()) names.push_back(printable(name, 40));
    }
    throw Error(
        ErrorKind::usage,
        fmt::format("{}: found '{}'{}, expected columns of {}: {}{}{} from 1 to {}",
                    mark(Setting::columns), printable(word, 40), why, mark_place(input.name()),
                    fmt::join(names, ", "), header.size() > names.size() ? ", ..." : "",
                    names.empty() ? "numbers" : ", or numbers", width));
  };
  // The number of a column, as written in the text. Returns 0 if the text is not a number.
  const auto number = [&](std::string_view text) -> std::size_t {
    std::size_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc{} && stop == text.data() + text.size();
    return whole && value <= width ? value : 0;
  };
  std::vector<bool> taken(width, false);
  const auto take = [&](std::size_t column, const std::string& word) {
    if (taken[column]) fail(word, " again");
    taken[column] = true;
  };
  for (const std::string& word : wanted) {
    if (const auto named = std::ranges::find(header, word); named != header.end()) {
      const auto column = static_cast<std::size_t>(named - header.begin());
      if (std::find(named + 1, header.end(), word) != header.end())
        fail(word, ", the name of several columns");
      if (number(word) != 0 && number(word) != column + 1)
        fail(word, fmt::format(", a name and the number of another column (by number: {0}-{0} "
                               "or {1}-{1})",
                               column + 1, number(word)));
      take(column, word);
      continue;
    }
    const std::size_t dash = word.find('-');
    const std::size_t first = number(std::string_view(word).substr(0, dash));
    const std::size_t last =
        dash == std::string::npos ? first : number(std::string_view(word).substr(dash + 1));
    if (first == 0 || last < first) fail(word, "");
    for (std::size_t k = first; k <= last; ++k) take(k - 1, word);
  }
  std::vector<std::size_t> columns;
  for (std::size_t k = 0; k < width; ++k)
    if (taken[k]) columns.push_back(k);
  return columns;
}

std::string_view without_quotes(std::string_view cell) {
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
    return cell.substr(1, cell.size() - 2);
  return cell;
}

bool is_missing_value(std::string_view cell) {
  cell = without_quotes(cell);
  return cell == "NA" || cell == "#N/A";
}

std::optional<double> number_in(std::string_view cell) {
  if (is_missing_value(cell)) return std::numeric_limits<double>::quiet_NaN();
  cell = without_quotes(cell);
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = std::numeric_limits<double>::quiet_NaN();
  const auto [stop, error] = floating_from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error == std::errc::invalid_argument || stop != cell.data() + cell.size())
    return std::nullopt;
  return value;
}

CellHints cell_hints(const ReadOptions& options) {
  const std::string some = mark(Setting::columns) + " takes only some columns";
  return {"are these names or an index? " + some,
          options.nan == NanPolicy::error
              ? mark(Setting::nan, "drop") + " accepts missing values; " + some
              : ""};
}

std::size_t count_cells(const TextLines& lines, char separator) {
  Cells cells(lines, {}, separator);
  std::size_t count = 0;
  for (cells.start(); cells.more(); ++count) cells.skip();
  return count;
}

bool ends_empty(std::string_view line) {
  return line.ends_with(',') || line.ends_with(';') || line.ends_with('\t');
}

void refuse_columns(const ReadOptions& options, std::string_view found) {
  if (!options.columns.empty())
    throw Error(
        ErrorKind::usage,
        fmt::format(
            "{}: makes sense only for tables in text files and for points in NPY files, found {}",
            mark(Setting::columns), found));
}

std::string matrix_option(const ReadOptions& options) {
  if (options.from_correlation) return mark(Setting::from_correlation);
  if (options.diagonal == Diagonal::births) return mark(Setting::diagonal, "births");
  if (options.symmetrise != Symmetrise::none) return mark(Setting::symmetrise);
  if (options.array != ArrayMeaning::distances) return "";
  return options.diagonal == Diagonal::zero ? "distances" : mark(Setting::diagonal);
}

}  // namespace ph::detail

namespace ph {

std::vector<std::string> header_names(std::string_view line) {
  return detail::header_cells(line, true);
}

}  // namespace ph
