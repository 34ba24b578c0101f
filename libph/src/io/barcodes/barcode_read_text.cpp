// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "libph/src/io/barcodes/barcode_read.hpp"
#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/detail/io/table.hpp"

namespace ph {
namespace {

/// The meaning of a column in a table of bars.
enum class Column { dim, birth, death, p, characteristic, other };

constexpr std::array<std::pair<std::string_view, Column>, 7> kNames{{
    {"dim", Column::dim},
    {"dimension", Column::dim},
    {"birth", Column::birth},
    {"death", Column::death},
    {"p", Column::p},
    {"persistence", Column::other},  // computed from birth and death
    {"lifetime", Column::other},
}};

/// The columns of a table, found from its header or its first row.
struct Columns {
  std::vector<Column> roles;
  /// The columns of a row, for messages.
  std::string expected = "dim birth death, or p dim birth death";
  /// Names of columns that cannot be stored in a Bar.
  std::vector<std::string> left_out;

  bool has(Column role) const { return std::ranges::find(roles, role) != roles.end(); }
};

// Adds a bar that was found in the current line.
void add_at(const TextLines& lines, Barcode& barcode, const Bar& bar) {
  if (const Fault fault = fault_of_bar(bar); !fault.what.empty()) {
    lines.fail(lines.line().data(), fault);
  }
  barcode.add(bar, {}, {});
}

/// True for the name of a column that says where a hole is, such as "birth_0" and "centroid_x".
bool is_place(std::string_view name) {
  if (name == "voxels" || name == "volume") return true;
  const std::size_t bar = name.find('_');
  if (bar == name.npos || name.size() == bar + 1) return false;
  const std::string_view end = name.substr(0, bar), axis = name.substr(bar + 1);
  return (end == "birth" || end == "death" || end == "centroid") &&
         (axis == "x" || axis == "y" || axis == "z" ||
          axis.find_first_not_of("0123456789") == axis.npos);
}

const Column* column_of(const std::string& name) {
  const std::string lower = lower_case(name);
  static constexpr Column kOther = Column::other;
  if (is_place(lower)) return &kOther;
  const auto* const found = std::ranges::find(kNames, lower, [](const auto& e) { return e.first; });
  return found == kNames.end() ? nullptr : &found->second;
}

/// True if the current line is a header. In a header, all cells are names, or at least one cell is
/// the name of a known column.
bool is_line_of_names(const TextLines& lines) {
  return !header_names(lines.line()).empty() ||
         std::ranges::any_of(detail::header_cells(lines.line(), false), column_of);
}

/// Finds the columns by the names in the current line, in any order. Returns nothing unless the
/// line names dimension, birth and death once each and all other names are known. The first column
/// may have no name. It is then an index, as written by pandas and R.
std::optional<Columns> columns_by_name(const TextLines& lines) {
  const std::vector<std::string> names = detail::header_cells(lines.line(), false);
  Columns columns;
  columns.expected = fmt::format("{}", fmt::join(names, ","));
  for (const std::string& name : names) {
    const Column* const known = column_of(name);
    const bool is_index = name.empty() && columns.roles.empty();  // mutant: bars-index
    if (known == nullptr && !is_index) return std::nullopt;
    const Column role = known == nullptr ? Column::other : *known;
    // mutant: bars-column-twice
    if (role != Column::other && columns.has(role)) return std::nullopt;
    if (known != nullptr && role > Column::p) columns.left_out.push_back(name);
    columns.roles.push_back(role);
  }
  for (const Column needed : {Column::dim, Column::birth, Column::death})
    if (!columns.has(needed)) return std::nullopt;
  return columns;
}

// R's write.table gives no name to its index column, whose cells are quoted.
void find_index(const TextLines& lines, Columns& columns) {
  // mutant: bars-cell-too-many
  if (lines.line().starts_with('"') && detail::count_cells(lines) == columns.roles.size() + 1)
    columns.roles.insert(columns.roles.begin(), Column::other);
}

/// Finds the columns of a table without a header from the number of cells in its first row. The
/// columns are `dim birth death` or, as in GUDHI's files, `p dim birth death`.
Columns columns_by_count(const TextLines& lines) {
  Cells counter(lines);
  std::size_t count = 0;
  for (counter.start(); counter.more(); ++count) counter.word();
  if (count == 2) {
    lines.fail(lines.line().data(), {"no dimension", "2 cells", "dim birth death", {}});
  }
  Columns columns;
  columns.roles = {Column::dim, Column::birth, Column::death};
  if (count == 4) columns.roles.insert(columns.roles.begin(), Column::characteristic);
  return columns;
}

/// Reads a dimension. Programs that store only floats write it as 1.0 or 1.000e+00.
int read_dimension(Cells& cells) {
  Cells ahead = cells;
  const std::string_view word = cells.more() ? ahead.word() : std::string_view();
  const double value = detail::number_in(word).value_or(-1);
  if (word.find_first_of(".eE") != word.npos && value >= 0 && value <= kMostBarDimension &&
      value == std::floor(value)) {
    cells = ahead;
    return static_cast<int>(value);
  }
  return static_cast<int>(cells.integer(0, kMostBarDimension, "dimension"));
}

double read_p(const TextLines& lines, Cells& cells) {
  const char* const begin = cells.place();
  const double p = cells.number(Allow::missing);
  if (!(std::isnan(p) || (p >= 0 && p <= 1)))
    lines.fail(begin, {"p-value", shortest(p), "a number from 0 to 1, or nothing", {}});
  return p;
}

void require_cell(const TextLines& lines, const Cells& cells, Column role,
                  const std::string& expected) {
  if (cells.more()) return;
  const auto* const name =
      std::ranges::find(kNames, role, [](const auto& entry) { return entry.second; });
  lines.fail(lines.line().data() + lines.line().size(),
             {fmt::format("{} missing", role == Column::dim ? "dimension" : name->first),
              "the end of the line",
              expected,
              {}});
}

/// A bar, and its p-value if it has one.
struct Row {
  Bar bar;
  double p = std::nan("");
};

// Reads the current line.
Row read_row(const TextLines& lines, const Columns& columns) {
  Cells cells(lines);
  cells.start();
  Row row;
  Bar& bar = row.bar;
  for (const Column role : columns.roles) {
    if (role <= Column::death) require_cell(lines, cells, role, columns.expected);
    switch (role) {
      case Column::dim:
        bar.dim = read_dimension(cells);
        break;
      case Column::birth:
        bar.birth = cells.number(Allow::infinite);
        break;
      case Column::death:
        bar.death = cells.number(Allow::infinite);
        break;
      case Column::p:
        if (cells.more()) row.p = read_p(lines, cells);
        break;
      case Column::characteristic:
        cells.integer(2, std::numeric_limits<std::int32_t>::max(), "characteristic");
        break;
      case Column::other:
        cells.skip();
        break;
    }
  }
  cells.expect_end(columns.expected);
  return row;
}

}  // namespace

StoredBarcode read_barcode_rows(const Input& input, bool may_be_empty) {
  StoredBarcode stored;
  std::optional<Columns> columns;
  TextLines lines(input);
  while (lines.next()) {
    if (!columns) {
      columns = columns_by_name(lines);
      if (columns) {
        stored.left_out = columns->left_out;
        if (!lines.next()) break;
        find_index(lines, *columns);
      }
    }
    if (!columns) {
      if (is_line_of_names(lines)) {
        lines.fail(lines.line().data(),
                   {"header",
                    '"' + printable(lines.line(), 40) + '"',
                    "the names dim, birth and death, and p where there are p-values",
                    {}});
      }
      columns = columns_by_count(lines);
    }
    const Row row = read_row(lines, *columns);
    add_at(lines, stored.bars, row.bar);
    if (columns->has(Column::p)) stored.p_values.push_back(row.p);
  }
  if (!columns && !may_be_empty) {
    input.fail({"no bars", "nothing", "a header or a line dim birth death", {}});
  }
  return stored;
}

bool has_barcode_header(const Input& input) {
  // The first bytes are checked before the input is read as lines, because the input is not always
  // text.
  constexpr std::size_t kProbe = 64;
  if (lower_case(input.text().substr(0, kProbe)).find("dim") == std::string::npos) return false;
  TextLines lines(input);
  return lines.next() && columns_by_name(lines).has_value();
}

// Reads Ripser's output, which has a heading for each dimension and lines ` [birth,death)`. Text
// before the first heading describes the input.
Barcode read_barcode_ripser(const Input& input) {
  Barcode barcode;
  TextLines lines(input);
  std::optional<int> dim;
  while (lines.next()) {
    std::string_view line = lines.line();
    if (line.starts_with(kRipserHeading) && line.ends_with(':')) {
      Cells cells(lines);
      line.remove_suffix(1);
      cells.start_in(line.substr(kRipserHeading.size()));
      dim = static_cast<int>(cells.integer(0, kMostBarDimension, "dimension"));
      cells.expect_end("the dimension alone");
      continue;
    }
    if (!dim) continue;
    const std::size_t comma = line.find(',');
    if (!line.starts_with('[') || !line.ends_with(')') || comma == std::string_view::npos) {
      lines.fail(line.data(), {"not an interval", printable(line, 40), "[birth,death)",
                               lines.offset() == input.size() ? "is the file truncated?" : ""});
    }
    Bar bar;
    bar.dim = *dim;
    Cells cells(lines);
    cells.start_in(line.substr(1, comma - 1));
    bar.birth = cells.number(Allow::infinite);
    cells.expect_end("one number");
    cells.start_in(line.substr(comma + 1, line.size() - comma - 2));
    if (cells.more()) {  // without a death, the class never dies
      bar.death = cells.number(Allow::infinite);
      cells.expect_end("one number");
    }
    add_at(lines, barcode, bar);
  }
  if (!dim) {
    input.fail({"no intervals", "no heading", "\"persistence intervals in dim 0:\"", {}});
  }
  return barcode;
}

}  // namespace ph
