// SPDX-License-Identifier: MIT
#include "table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "readers.hpp"

namespace ph::detail {
namespace {

constexpr std::size_t kShownNames = 10;

bool is_number(std::string_view cell) {
  cell = without_quotes(cell);
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error != std::errc::invalid_argument && stop == cell.data() + cell.size();
}

// Cells of a line with its first one empty, as tables have it whose rows have names.
std::vector<std::string> unnamed_header(std::string_view line) {
  const std::size_t mark = line.find_first_of(",;");
  if (mark == std::string_view::npos) return {};
  const std::string_view first = line.substr(0, mark);
  if (!first.empty() && first != "\"\"") return {};
  const char separator = line[mark];
  std::vector<std::string> names{""};
  bool is_named = false;
  for (std::string_view rest = line.substr(mark + 1);;) {
    std::size_t end = 0;
    for (bool in_quotes = false; end < rest.size() && (in_quotes || rest[end] != separator); ++end)
      if (rest[end] == '"') in_quotes = !in_quotes;
    std::string_view name = rest.substr(0, end);
    while (name.starts_with(' ') || name.starts_with('\t')) name.remove_prefix(1);
    while (name.ends_with(' ') || name.ends_with('\t')) name.remove_suffix(1);
    names.emplace_back(without_quotes(name));
    is_named = is_named || !names.back().empty();
    if (end == rest.size()) break;
    rest.remove_prefix(end + 1);
  }
  return is_named ? names : std::vector<std::string>();
}

bool is_name_of_index(std::string name) {
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  constexpr std::array<std::string_view, 10> kNames{
      "", "index", "idx", "id", "no", "nr", "row", "rownames", "level_0", "unnamed: 0"};
  return std::ranges::find(kNames, name) != kNames.end();
}

bool begins_empty(std::string_view line) { return line.find_first_of(",;") == 0; }

// The first column of the rows from here on.
struct FirstColumn {
  std::size_t rows = 0;
  bool counts = true;         // 0, 1, 2, … or 1, 2, 3, …
  bool names_columns = true;  // row k has the name of column k
};

FirstColumn first_column(const Input& input, const TableLayout& layout) {
  FirstColumn column;
  TextLines lines(input);
  Cells cells(lines);
  if (!layout.start(lines)) return column;
  std::int64_t least = 0;
  do {
    cells.start();
    if (!cells.more()) continue;
    const std::string_view cell = without_quotes(cells.skip());
    std::int64_t number = -1;
    const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    const bool whole = error == std::errc{} && stop == cell.data() + cell.size();
    if (column.rows == 0) least = number;
    column.counts = column.counts && whole && (least == 0 || least == 1) &&
                    number == least + static_cast<std::int64_t>(column.rows);
    column.names_columns = column.names_columns && column.rows + 1 < layout.header.size() &&
                           layout.header[column.rows + 1] == cell;
    ++column.rows;
    if (!column.counts && !column.names_columns) break;
  } while (lines.next());
  return column;
}

std::vector<std::size_t> range(std::size_t begin, std::size_t end) {
  std::vector<std::size_t> all;
  for (std::size_t k = begin; k < end; ++k) all.push_back(k);
  return all;
}

// Cells of a row; where an empty one is no error, the last one may be.
std::size_t count_cells(const TextLines& lines, const TableLayout& layout,
                        const ReadOptions& options) {
  Cells cells(lines);
  std::size_t count = 0;
  for (cells.start(); cells.more(); ++count) cells.skip();
  const bool is_last_missing = options.nan == NanPolicy::drop &&
                               count + 1 == layout.header.size() && ends_empty(lines.line());
  return count + (is_last_missing ? 1 : 0);
}

// Whether the first column has names, or counts the rows; says why in a note.
bool leads_with_names(const Input& input, TableLayout& layout, std::string_view first_cell) {
  if (layout.width < 2) return false;
  const bool is_full = layout.header.size() == layout.width;
  const bool is_one_short = layout.header.size() + 1 == layout.width;  // as R writes it
  if (is_full && layout.header[0].empty()) {
    layout.notes.push_back(
        fmt::format("the first column has no name, as an index of the rows: left out; --columns "
                    "1-{} takes it, too",
                    layout.width));
    return true;
  }
  const bool is_index = is_full && is_name_of_index(layout.header[0]);
  if (!is_number(first_cell)) {
    if (!is_index && !is_one_short && !(is_full && first_column(input, layout).names_columns))
      return false;
    layout.notes.push_back("the first column has names of the rows: left out");
    return true;
  }
  if (!is_index && !is_one_short) return false;
  const std::string name = is_index ? fmt::format(", {},", printable(layout.header[0], 40)) : "";
  if (first_column(input, layout).counts) {
    layout.notes.push_back(
        fmt::format("the first column{} counts the rows: left out; --columns 1-{} takes it, too",
                    name, layout.width));
    return true;
  }
  if (is_index)
    layout.notes.push_back(
        fmt::format("the first column{} is taken as numbers; --columns 2-{} leaves it out", name,
                    layout.width));
  return false;
}

}  // namespace

std::vector<bool> TableLayout::taken() const {
  std::vector<bool> taken(width, false);
  for (const std::size_t column : columns) taken[column] = true;
  return taken;
}

bool TableLayout::start(TextLines& lines) const {
  if (!lines.next()) return false;
  return header.empty() || lines.next();
}

void TableLayout::tell(const ReadOptions& options) const {
  for (const std::string& text : notes) note(options, text);
}

TableLayout table_layout(const Input& input, const ReadOptions& options) {
  TableLayout layout;
  TextLines lines(input);
  if (!lines.next()) return layout;
  layout.header = header_names(lines.line());
  const bool is_unnamed = layout.header.empty();
  if (is_unnamed) layout.header = unnamed_header(lines.line());
  layout.header_line = lines.number();
  TextLines next(lines);
  const bool has_next = next.next();
  if (is_unnamed && !layout.header.empty() &&
      (!has_next || begins_empty(next.line()) ||
       count_cells(next, layout, options) != layout.header.size())) {
    layout.header.clear();  // a row that begins with an empty cell
  }
  const bool has_header = !layout.header.empty();
  if (has_header)
    layout.notes.push_back(fmt::format("line {} is a header: skipped", layout.header_line));
  if (has_header && !has_next) return layout;
  const TextLines& row = has_header ? next : lines;
  layout.width = count_cells(row, layout, options);
  if (!options.columns.empty()) {
    const bool named = layout.header.size() == layout.width;
    layout.columns = chosen_columns(
        options.columns, named ? layout.header : std::vector<std::string>(), layout.width, input);
    return layout;
  }
  Cells cells(row);
  cells.start();
  layout.names_rows = leads_with_names(input, layout, cells.skip());
  layout.columns = range(layout.names_rows ? 1 : 0, layout.width);
  return layout;
}

std::vector<std::size_t> chosen_columns(const std::vector<std::string>& wanted,
                                        const std::vector<std::string>& header, std::size_t width,
                                        const Input& input) {
  const auto fail = [&](const std::string& word, std::string_view why) {
    std::vector<std::string> names;
    for (const std::string& name : header) {
      if (names.size() == kShownNames) break;
      names.push_back(printable(name, 40));
    }
    throw Error(ErrorKind::usage,
                fmt::format("--columns: found '{}'{}, expected columns of {}: {}{}{} from 1 to {}",
                            printable(word, 40), why, input.name(), fmt::join(names, ", "),
                            header.size() > names.size() ? ", ..." : "",
                            names.empty() ? "numbers" : ", or numbers", width));
  };
  const auto number = [&](std::string_view text) -> std::size_t {  // 0: none
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
      take(static_cast<std::size_t>(named - header.begin()), word);
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

SquareKind kind_of_square(std::span<const double> block, std::size_t side) {
  double largest = 0;
  bool symmetric = true, positive = true, in_one = true;
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      const double value = block[i * side + j], other = block[j * side + i];
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
      in_one = in_one && !(std::abs(value) > 1 + kRounding);
      if (i == j || std::isnan(value)) {
        symmetric = symmetric && (i == j || std::isnan(other));
        continue;
      }
      positive = positive && value >= 0;
      symmetric = symmetric &&
                  (value == other || std::abs(value - other) <=
                                         kRounding * std::max(std::abs(value), std::abs(other)));
    }
  }
  bool zeros = true, ones = true, known = false;
  for (std::size_t i = 0; i < side; ++i) {
    const double value = block[i * side + i];
    if (std::isnan(value)) continue;
    known = true;
    zeros = zeros && std::abs(value) <= kRounding * largest;
    ones = ones && std::abs(value - 1) <= kRounding;
  }
  if (known && zeros) return symmetric && positive ? SquareKind::distances : SquareKind::zeros;
  if (!symmetric) return SquareKind::nothing;
  return known && ones && in_one ? SquareKind::correlations : SquareKind::symmetric;
}

std::string_view without_quotes(std::string_view cell) {
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
    return cell.substr(1, cell.size() - 2);
  return cell;
}

bool ends_empty(std::string_view line) { return line.ends_with(',') || line.ends_with(';'); }

bool is_mostly_zero(std::span<const double> block, std::size_t side) {
  std::size_t zeros = 0;
  for (std::size_t i = 0; i < side; ++i)
    for (std::size_t j = 0; j < side; ++j) zeros += i != j && block[i * side + j] == 0 ? 1 : 0;
  return 2 * zeros > side * (side - 1);
}

void refuse_columns(const ReadOptions& options, std::string_view found) {
  if (!options.columns.empty())
    throw Error(ErrorKind::usage,
                fmt::format("--columns: makes sense for points and matrices as text only, found {}",
                            found));
}

std::string_view matrix_option(const ReadOptions& options) {
  if (options.from_correlation) return "--from-correlation";
  if (options.births_on_diagonal) return "--diagonal births";
  if (options.symmetrise != Symmetrise::none) return "--symmetrise";
  return options.array == ArrayMeaning::distances ? "--diagonal" : "";
}

}  // namespace ph::detail
