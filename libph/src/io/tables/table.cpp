// SPDX-License-Identifier: MIT
#include "ph/detail/io/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/core/lower_case.hpp"

namespace ph::detail {
namespace {

bool begins_empty(std::string_view line) { return line.find_first_of(",;\t") == 0; }

bool is_number(std::string_view cell) { return number_in(cell).has_value(); }

bool is_whole(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

// The cells of a header whose first cell is empty, as in a table with named rows. Returns no cells
// if the line is not such a header. The names may be integers if these integers number the columns,
// or if the next line begins with a name or with the first of these integers.
std::vector<std::string> unnamed_header(std::string_view line, std::string_view first_of_next) {
  if (!begins_empty(line) && !line.starts_with("\"\"")) return {};
  std::vector<std::string> names = header_cells(line, false, true);
  if (names.empty() || !names.front().empty()) return {};
  bool is_named = false, has_numbers = false, counts = true, are_whole = true;
  for (std::size_t k = 1; k < names.size(); ++k) {
    is_named = is_named || !names[k].empty();
    has_numbers = has_numbers || number_in(names[k]);
    are_whole = are_whole && (!number_in(names[k]) || is_whole(names[k]));
    counts = counts && names[k] == std::to_string(names[1] == "0" ? k - 1 : k);
  }
  const bool has_name = !first_of_next.empty() && !number_in(first_of_next);
  const bool are_names =
      !has_numbers || counts || (are_whole && (has_name || first_of_next == names[1]));
  if (!is_named || !are_names) names.clear();  // mutant: guess-names
  return names;
}

bool is_name_of_index(std::string_view name) {
  constexpr std::array<std::string_view, 10> kNames{
      "", "index", "idx", "id", "no", "nr", "row", "rownames", "level_0", "unnamed: 0"};
  return std::ranges::find(kNames, lower_case(name)) != kNames.end();
}

// Describes the first column of a table.
struct FirstColumn {
  std::size_t rows = 0;
  bool counts = true;         // true for 0, 1, 2, … or 1, 2, 3, …
  bool names_columns = true;  // true if row k begins with the name of column k
};

// Looks at the first column of the first `most` rows.
FirstColumn first_column(const Input& input, const TableLayout& layout,
                         std::size_t most = std::numeric_limits<std::size_t>::max()) {
  FirstColumn column;
  TextLines lines = layout.lines(input);
  Cells cells(lines, {}, layout.separator);
  if (!layout.start(lines)) return column;
  double least = 0;
  do {
    cells.start();
    if (!cells.more()) continue;
    const std::string_view cell = without_quotes(cells.skip());
    const double number = number_in(cell).value_or(-1);
    if (column.rows == 0) least = number;
    column.counts = column.counts && (least == 0 || least == 1) &&
                    number == least + static_cast<double>(column.rows);
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

// The cells of a line 0, 1, 2, … or 1, 2, 3, …, which may number the columns. Returns nothing for
// any other line.
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

// Removes a header or an index column that consists of the numbers 0, 1, 2, … (or 1, 2, 3, …), if a
// square matrix remains without it. These numbers could be mistaken for data.
void leave_counts_out(const Input& input, const TextLines& first, const ReadOptions& options,
                      TableLayout& layout) {
  const auto is_matrix = [&](const TableLayout& rest) {
    const TableShape shape = shape_of(input, rest);
    return rest.columns.size() > 2 && shape.rows == rest.columns.size() &&
           shape.square != SquareKind::nothing;
  };
  const std::size_t n = layout.width;
  if (std::vector<std::string> names = counting_header(first); names.size() == n) {
    TableLayout rest = layout;
    rest.header = std::move(names);
    rest.columns = range(0, n);
    if (is_matrix(rest)) {  // mutant: guess-header
      layout.header = std::move(rest.header);
      layout.notes.push_back(fmt::format(
          "line {} holds the column numbers of a symmetric matrix: skipped", first.number()));
      return;
    }
  }
  if (!options.columns.empty()) return;
  TableLayout rest = layout;
  rest.columns = range(1, n);
  rest.names_rows = true;
  if (first_column(input, rest, n).counts && is_matrix(rest)) {
    layout.names_rows = true;
    layout.notes.emplace_back(
        "the first column holds the row numbers of a symmetric matrix: left out");
  }
}

// The number of cells in the first row. An empty last cell counts as a missing value if the header
// has a name for it or if one of the next rows has a cell there.
std::size_t width_of(const TextLines& row, const TableLayout& layout) {
  const std::size_t count = count_cells(row, layout.separator);
  if (!ends_empty(row.line())) return count;  // mutant: guess-empty-cell
  std::size_t cells = layout.header.size() == count + 1 ? count + 1 : count;
  TextLines next(row);
  for (std::size_t k = 0; k < kMostLookedAt && cells == count && next.next(); ++k)
    cells = count_cells(next, layout.separator);
  return count + (cells == count + 1 ? 1 : 0);
}

// Advice to read the first column as well. The text is empty for a square matrix, which would not
// be square with this column.
std::string way_to_take_it(const Input& input, const TableLayout& layout) {
  TableLayout rest = layout;
  rest.columns = range(1, layout.width);
  rest.names_rows = true;
  const bool is_square = shape_of(input, rest).rows == rest.columns.size();
  return is_square ? ""
                   : fmt::format("; {} also takes {}",
                                 mark(Setting::columns, fmt::format("1-{}", layout.width)),
                                 layout.unnamed() > 1 ? "them" : "it");
}

std::string_view first_cell(const TextLines& line, const TableLayout& layout) {
  Cells cells(line, {}, layout.separator);
  cells.start();
  return cells.more() ? cells.skip() : std::string_view();
}

// True if blanks separate numbers in the entire line or between two tabs.
bool has_blanks_between_numbers(std::string_view line) {
  const bool has_tabs = separator_in(line) == '\t';
  return std::ranges::any_of(
      has_tabs ? header_cells(line, false, true) : std::vector<std::string>{std::string(line)},
      [&](const std::string& cell) {
        const std::vector<std::string> words = header_cells(cell, false);
        return (words.size() > 1 || !has_tabs) && std::ranges::all_of(words, is_number);
      });
}

// True if each tab separates two cells. If blanks also separate numbers, tabs separate cells only
// if a header and the first row have the same number of cells between tabs.
bool has_tabs_between_cells(const Input& input) {
  TextLines lines(input);
  lines.keep_tabs();
  std::vector<std::string_view> rows;  // the header, if there is one, and a row
  while (rows.size() < 2 && lines.next())
    if (lines.line().find_first_not_of(" \t") != std::string_view::npos)
      rows.push_back(lines.line());
  const auto has = [&](char separator) {
    return std::ranges::count(rows, separator, separator_in);
  };
  if (has('\t') == 0 || has(',') + has(';') > 0) return false;
  const auto width = [&](std::size_t k) { return header_cells(rows[k], false, true).size(); };
  const bool fit = has('\t') == 2 && !header_cells(rows[0], true, true).empty() && width(0) > 1 &&
                   width(0) == width(1);
  return fit || std::ranges::none_of(rows, has_blanks_between_numbers);
}

// True if --columns contains a cell of this line that is not the number of a column. The line is
// then a header. A user who counts columns from 0 may have written 0 by mistake. The 0 is taken as
// a name only if the line is 0, 1, 2, … and the next line has a cell that is not a whole number.
bool asks_for_names(const ReadOptions& options, const std::vector<std::string>& names,
                    const std::vector<std::string>& next) {
  bool may_be_0 = !std::ranges::all_of(next, is_whole);
  for (std::size_t k = 0; k < names.size(); ++k)
    may_be_0 = may_be_0 && names[k] == std::to_string(k);
  return std::ranges::any_of(options.columns, [&](const std::string& word) {
    const double number = number_in(word).value_or(-1);
    const bool is_place =
        number >= (may_be_0 ? 1 : 0) && number <= static_cast<double>(names.size());
    return !is_place && std::ranges::find(names, word) != names.end();
  });
}

// True if the first line may be a header whose names are integers, such as years. In this kind of
// header, the columns that are read have integers, while a column that is not read has a name. The
// next line has fractions in the columns that are read.
bool may_be_names(const TextLines& first, const TextLines& next, const TableLayout& layout) {
  const std::vector<bool> taken = layout.taken();
  const auto looks = [&](const TextLines& line) {
    bool has_names = false, are_whole = true;
    Cells cells(line, {}, layout.separator);
    cells.start();
    for (std::size_t k = 0; k < taken.size() && cells.more(); ++k) {
      const std::string_view cell = without_quotes(cells.skip());
      has_names = has_names || (!taken[k] && !cell.empty() && !number_in(cell));
      are_whole = are_whole && (!taken[k] || is_whole(cell));
    }
    return std::pair(has_names, are_whole);
  };
  return looks(first) == std::pair(true, true) && !looks(next).second;
}

// The number of rows that a line states, if the line has one whole number and the rows after it
// have several cells: as many as the header or, without a header, two rows alike. A single row
// after a number may be the second row of a triangle of distances. After a header of several names,
// the file may end before or within the first row.
std::optional<std::size_t> number_of_rows(const TextLines& line, std::size_t names) {
  constexpr std::size_t most_digits = 15;
  const std::string_view text = line.line();
  if (!is_whole(text) || text.size() > most_digits) return std::nullopt;
  TextLines row(line);
  const auto width = [&] {
    if (!row.next()) return std::size_t{0};
    const char separator = separator_in(row.line());
    return count_cells(row, separator == '\t' ? ' ' : separator);
  };
  const std::size_t first = width();
  const bool is_cut_off = first < names && names > 1 && (first == 0 || width() == 0);
  if (!is_cut_off && (first < 2 || (names > 0 ? names != first : first != width())))
    return std::nullopt;
  std::size_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

// True if the first column is left out because it contains the names or the numbers of the rows. In
// this case, a note gives the reason.
bool leads_with_names(const Input& input, TableLayout& layout, std::string_view first_cell) {
  if (layout.width < 2) return false;
  const bool is_full = layout.header.size() == layout.width;
  // R writes no name for the column of row names.
  const bool is_one_short = layout.header.size() + 1 == layout.width;
  if (is_full && layout.header[0].empty()) {
    const bool is_one = layout.unnamed() == 1;
    layout.notes.push_back(
        fmt::format("the first {} no name, like a row index: left out{}",
                    is_one ? "column has" : fmt::format("{} columns have", layout.unnamed()),
                    number_in(first_cell) ? way_to_take_it(input, layout) : ""));
    return true;
  }
  const bool is_index = is_full && is_name_of_index(layout.header[0]);
  const bool is_quoted = is_one_short && first_cell.starts_with('"');
  if (!number_in(first_cell) || is_quoted) {
    if (!is_index && !is_one_short && !(is_full && first_column(input, layout).names_columns))
      return false;
    layout.notes.emplace_back("the first column holds row names: left out");
    return true;
  }
  if (!is_index && !is_one_short) return false;
  const std::string name = is_index ? fmt::format(", {},", printable(layout.header[0], 40)) : "";
  if (first_column(input, layout).counts) {
    layout.notes.push_back(fmt::format("the first column{} holds row numbers: left out{}", name,
                                       way_to_take_it(input, layout)));
    return true;
  }
  if (is_index)
    layout.notes.push_back(
        Message::guess(fmt::format("the first column{} is read as numbers; {} leaves it out", name,
                                   mark(Setting::columns, fmt::format("2-{}", layout.width)))));
  return false;
}

}  // namespace

std::vector<bool> TableLayout::taken() const {
  std::vector<bool> taken(width, false);
  for (const std::size_t column : columns) taken[column] = true;
  return taken;
}

std::size_t TableLayout::unnamed() const {
  const auto named = std::ranges::find_if(header, [](const auto& name) { return !name.empty(); });
  return static_cast<std::size_t>(named - header.begin());
}

TextLines TableLayout::lines(const Input& input) const {
  TextLines lines(input);
  if (keeps_tabs) lines.keep_tabs();
  return lines;
}

bool TableLayout::start(TextLines& lines) const {
  for (int before = (header.empty() ? 0 : 1) + (said ? 1 : 0); before > 0; --before)
    if (!lines.next()) return false;
  return lines.next();
}

void TableLayout::tell(const ReadOptions& options) const {
  for (const Message& text : notes) note(options, text);
}

TableLayout table_layout(const Input& input, const ReadOptions& options) {
  TableLayout layout;
  layout.keeps_tabs = has_tabs_between_cells(input);  // mutant: guess-tabs
  TextLines lines = layout.lines(input);
  if (!lines.next()) return layout;
  TextLines next(lines);
  const bool has_next = next.next();
  const auto separator = [&](const TextLines& row) {
    const char found = separator_in(row.line());
    return found == '\t' && !layout.keeps_tabs ? ' ' : found;
  };
  if (has_next) layout.separator = separator(next);
  layout.header = header_cells(lines.line(), true, layout.keeps_tabs);
  if (layout.header.empty() && has_next) {
    layout.header = unnamed_header(lines.line(), without_quotes(first_cell(next, layout)));
    if (begins_empty(next.line()) || width_of(next, layout) != layout.header.size())
      layout.header.clear();  // the line is not a header, but a row that begins with an empty cell
  }
  if (layout.header.empty() && has_next && !options.columns.empty()) {
    std::vector<std::string> names = header_cells(lines.line(), false, layout.keeps_tabs);
    if (asks_for_names(options, names, header_cells(next.line(), false, layout.keeps_tabs)))
      layout.header = std::move(names);
  }
  const bool has_header = !layout.header.empty();
  if (has_header)
    layout.notes.push_back(fmt::format("line {} is a header: skipped", lines.number()));
  if (has_header && !has_next) return layout;
  TextLines row = has_header ? next : lines;
  layout.said = number_of_rows(row, layout.header.size());
  if (layout.said) {
    layout.said_line = row.number();
    layout.notes.push_back(
        fmt::format("line {} says the number of rows, {}: skipped", row.number(), *layout.said));
    if (!row.next()) return layout;
  }
  layout.separator = separator(row);
  layout.width = width_of(row, layout);
  // In points and pictures, a row or a column that counts may be data, even if the rest happens to
  // be symmetric.
  if (!has_header && !layout.said && options.array != ArrayMeaning::points &&
      options.array != ArrayMeaning::image)
    leave_counts_out(input, lines, options, layout);
  if (!options.columns.empty()) {
    std::vector<std::string> names = layout.header;
    // R writes no name for the column of row names.
    if (names.size() + 1 == layout.width) names.insert(names.begin(), "");
    if (names.size() != layout.width) names.clear();
    layout.columns = chosen_columns(options.columns, names, layout.width, input);
    if (!has_header && has_next && may_be_names(lines, next, layout))
      layout.notes.push_back(Message::guess(
          fmt::format("line {} is read as numbers; remove it if it is a header", lines.number())));
    return layout;
  }
  if (has_header) layout.names_rows = leads_with_names(input, layout, first_cell(row, layout));
  const std::size_t index = std::max<std::size_t>(layout.unnamed(), 1);
  layout.columns = range(layout.names_rows ? index : 0, layout.width);  // mutant: guess-index
  return layout;
}

}  // namespace ph::detail
