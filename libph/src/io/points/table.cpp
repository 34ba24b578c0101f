// SPDX-License-Identifier: MIT
#include "io/points/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/floating.hpp"
#include "io/readers.hpp"

namespace ph::detail {
namespace {

constexpr std::size_t kShownNames = 10;

bool begins_empty(std::string_view line) { return line.find_first_of(",;") == 0; }

// Cells of a line with its first one empty, as tables have it whose rows have names.
std::vector<std::string> unnamed_header(std::string_view line) {
  if (!begins_empty(line) && !line.starts_with("\"\"")) return {};
  std::vector<std::string> names = header_cells(line, false);
  const bool is_named =
      std::ranges::any_of(names, [](const std::string& name) { return !name.empty(); });
  if (!is_named || !names.front().empty()) names.clear();
  return names;
}

bool is_name_of_index(std::string name) {
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  constexpr std::array<std::string_view, 10> kNames{
      "", "index", "idx", "id", "no", "nr", "row", "rownames", "level_0", "unnamed: 0"};
  return std::ranges::find(kNames, name) != kNames.end();
}

// The first column.
struct FirstColumn {
  std::size_t rows = 0;
  bool counts = true;         // 0, 1, 2, … or 1, 2, 3, …
  bool names_columns = true;  // row k has the name of column k
};

// Of the first rows, `most` of them at most.
FirstColumn first_column(const Input& input, const TableLayout& layout,
                         std::size_t most = std::numeric_limits<std::size_t>::max()) {
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
  } while (column.rows < most && lines.next());
  return column;
}

std::vector<std::size_t> range(std::size_t begin, std::size_t end) {
  std::vector<std::size_t> all;
  for (std::size_t k = begin; k < end; ++k) all.push_back(k);
  return all;
}

// Whether a line is 0, 1, 2, … or 1, 2, 3, …, as tables have it whose columns have numbers.
std::vector<std::string> counting_header(const TextLines& line) {
  std::vector<std::string> names;
  Cells cells(line);
  for (cells.start(); cells.more();) {
    names.emplace_back(without_quotes(cells.skip()));
    const std::size_t first = names.front() == "0" ? 0 : 1;
    if (names.back() != std::to_string(first + names.size() - 1)) return {};
  }
  return names;
}

// Names and an index that a matrix has though they look like its numbers: n rows are symmetric
// behind a line that counts the columns, or behind a column that counts the rows.
void leave_counts_out(const Input& input, const TextLines& first, const ReadOptions& options,
                      TableLayout& layout) {
  const auto is_matrix = [&](const TableLayout& rest) {
    const TableShape shape = shape_of(input, rest);
    return rest.columns.size() > 2 && shape.rows == rest.columns.size() &&
           shape.square != SquareKind::nothing;
  };
  const std::size_t n = layout.width;
  if (std::vector<std::string> names = counting_header(first); names.size() == n) {
    TableLayout rest{.header = std::move(names), .width = n, .columns = range(0, n)};
    if (is_matrix(rest)) {
      layout.header = std::move(rest.header);
      layout.notes.push_back(fmt::format(
          "line {} counts the columns of a symmetric matrix: a header, skipped", first.number()));
      return;
    }
  }
  if (!options.columns.empty()) return;
  const TableLayout rest{.width = n, .columns = range(1, n), .names_rows = true};
  if (first_column(input, rest, n).counts && is_matrix(rest)) {
    layout.names_rows = true;
    layout.notes.emplace_back("the first column counts the rows of a symmetric matrix: left out");
  }
}

// Cells of a row. An empty last one counts if the header has a name for it: it is a missing value.
std::size_t width_of(const TextLines& lines, const TableLayout& layout) {
  const std::size_t count = count_cells(lines);
  return count + (count + 1 == layout.header.size() && ends_empty(lines.line()) ? 1 : 0);
}

// How to read the first column, too; nothing of a square matrix, which it would make none.
std::string way_to_take_it(const Input& input, const TableLayout& layout) {
  const TableLayout rest{.header = layout.header,
                         .width = layout.width,
                         .columns = range(1, layout.width),
                         .names_rows = true};
  const bool is_square = shape_of(input, rest).rows == rest.columns.size();
  return is_square ? "" : fmt::format("; --columns 1-{} takes it, too", layout.width);
}

// Whether the first column has names, or counts the rows; says why in a note.
bool leads_with_names(const Input& input, TableLayout& layout, std::string_view first_cell) {
  if (layout.width < 2) return false;
  const bool is_full = layout.header.size() == layout.width;
  const bool is_one_short = layout.header.size() + 1 == layout.width;  // as R writes it
  if (is_full && layout.header[0].empty()) {
    layout.notes.push_back(
        fmt::format("the first column has no name, as an index of the rows: left out{}",
                    number_in(first_cell) ? way_to_take_it(input, layout) : ""));
    return true;
  }
  const bool is_index = is_full && is_name_of_index(layout.header[0]);
  if (!number_in(first_cell)) {
    if (!is_index && !is_one_short && !(is_full && first_column(input, layout).names_columns))
      return false;
    layout.notes.emplace_back("the first column has names of the rows: left out");
    return true;
  }
  if (!is_index && !is_one_short) return false;
  const std::string name = is_index ? fmt::format(", {},", printable(layout.header[0], 40)) : "";
  if (first_column(input, layout).counts) {
    layout.notes.push_back(fmt::format("the first column{} counts the rows: left out{}", name,
                                       way_to_take_it(input, layout)));
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
  TextLines next(lines);
  const bool has_next = next.next();
  if (is_unnamed && !layout.header.empty() &&
      (!has_next || begins_empty(next.line()) || width_of(next, layout) != layout.header.size())) {
    layout.header.clear();  // a row that begins with an empty cell
  }
  const bool has_header = !layout.header.empty();
  if (has_header)
    layout.notes.push_back(fmt::format("line {} is a header: skipped", lines.number()));
  if (has_header && !has_next) return layout;
  const TextLines& row = has_header ? next : lines;
  layout.width = width_of(row, layout);
  // Points and pictures may well be symmetric behind numbers that count.
  if (!has_header && options.array != ArrayMeaning::points && options.array != ArrayMeaning::image)
    leave_counts_out(input, lines, options, layout);
  if (!options.columns.empty()) {
    std::vector<std::string> names = layout.header;
    if (names.size() + 1 == layout.width) names.insert(names.begin(), "");  // as R writes it
    if (names.size() != layout.width) names.clear();
    layout.columns = chosen_columns(options.columns, names, layout.width, input);
    return layout;
  }
  Cells cells(row);
  cells.start();
  if (has_header) layout.names_rows = leads_with_names(input, layout, cells.skip());
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
      if (!name.empty()) names.push_back(printable(name, 40));
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

bool is_missing_value(std::string_view cell) { return without_quotes(cell) == "NA"; }

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
  return {"names or an index? --columns takes some columns only",
          options.nan == NanPolicy::error
              ? "--nan drop accepts missing values; --columns takes some columns only"
              : ""};
}

std::size_t count_cells(const TextLines& lines) {
  Cells cells(lines);
  std::size_t count = 0;
  for (cells.start(); cells.more(); ++count) cells.skip();
  return count;
}

bool ends_empty(std::string_view line) { return line.ends_with(',') || line.ends_with(';'); }

void refuse_columns(const ReadOptions& options, std::string_view found) {
  if (!options.columns.empty())
    throw Error(ErrorKind::usage,
                fmt::format("--columns: makes sense for points and matrices as text only, found {}",
                            found));
}

std::string_view matrix_option(const ReadOptions& options) {
  if (options.from_correlation) return "--from-correlation";
  if (options.diagonal == Diagonal::births) return "--diagonal births";
  if (options.symmetrise != Symmetrise::none) return "--symmetrise";
  return options.array == ArrayMeaning::distances ? "--diagonal" : "";
}

}  // namespace ph::detail
