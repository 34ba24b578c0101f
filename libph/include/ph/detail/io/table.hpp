// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ph/io/read.hpp"

// The parts of a table: names, an index, numbers; and the possible meanings of a square table.

namespace ph::detail {

/// The position of the numbers in a text table.
struct TableLayout {
  /// Names of the columns, from the first line; may be empty.
  std::vector<std::string> header = {};
  std::size_t width = 0;                  ///< cells of the first row; 0 if there is no row
  std::vector<std::size_t> columns = {};  ///< the columns that hold numbers to be read, ascending
  bool names_rows = false;                ///< the columns before the first of these index the rows
  std::vector<Message> notes = {};        ///< assumptions that were made
  char separator = ' ';     ///< separator of the first row: ',', ';', a tab, or blanks
  bool keeps_tabs = false;  ///< each tab separates two cells
  /// The number of rows that a line of its own before the rows states, as CloudCompare writes it.
  std::optional<std::size_t> said = {};
  std::size_t said_line = 0;  ///< the number of this line

  /// Number of leading columns that have no name although there is a header.
  std::size_t unnamed() const;
  /// The lines of the table, positioned before the first one.
  TextLines lines(const Input& input) const;
  /// True for each column k < width that is one of `columns`.
  std::vector<bool> taken() const;
  /// Goes to the first row, after the header and the number of rows. @return true if there is one.
  bool start(TextLines& lines) const;
  /// Passes the notes to options.note.
  void tell(const ReadOptions& options) const;
};

/// Finds the layout of a table from its first lines and, if they do not decide, from its first
/// column. The first column is left out if it has no name, or if it has a usual name of an index
/// (id, index, …) and counts the rows.
/// @throws Error (usage) if options.columns names a missing column.
TableLayout table_layout(const Input& input, const ReadOptions& options);

/// The number in a cell, NaN if double cannot hold it; empty if it is not a number.
std::optional<double> number_in(std::string_view cell);
/// True if a cell is NA or #N/A, which R and spreadsheets write for a missing value.
bool is_missing_value(std::string_view cell);
/// A cell without the double quotes around it.
std::string_view without_quotes(std::string_view cell);
/// The cells of a line of names. Quotes around cells, an empty last cell, and two slashes before
/// the first cell are removed.
/// @param names_only the result is empty if a cell is a number or empty.
/// @param keeps_tabs each tab separates two cells; otherwise any number of tabs does.
std::vector<std::string> header_cells(std::string_view line, bool names_only,
                                      bool keeps_tabs = false);
/// The separator of the cells of a line: the first comma, semicolon or tab outside quotes; blanks
/// if there is none.
char separator_in(std::string_view line);
/// Number of cells in the current line, without an empty last one. @param separator see Cells.
std::size_t count_cells(const TextLines& lines, char separator = ' ');
/// True if a line ends in a separator: if another cell is expected, that cell is empty.
bool ends_empty(std::string_view line);

/// Advice about a cell of a table that is not a number.
CellHints cell_hints(const ReadOptions& options);

/// The columns that a list of names and numbers from 1 ("x", "3", "2-5") stands for, ascending.
/// @param header may be empty. @throws Error (usage) on a column that does not exist, is repeated,
/// is the name of several columns, or is the name of one column and the number of another. (The
/// range "2-2" can only mean a number.)
std::vector<std::size_t> chosen_columns(const std::vector<std::string>& wanted,
                                        const std::vector<std::string>& header, std::size_t width,
                                        const Input& input);

/// The appearance of a square table of numbers.
enum class SquareKind {
  nothing,              ///< not a symmetric matrix
  zeros,                ///< a diagonal of zeros, but asymmetric or with negative entries
  distances,            ///< symmetric, not negative, with a diagonal of zeros
  correlations,         ///< symmetric, from -1 to 1, with a diagonal of ones
  symmetric,            ///< symmetric, but none of the above
  nearly_correlations,  ///< as correlations, except for at most one pair in ten or small
                        ///< differences
  nearly_symmetric,     ///< symmetric, except for at most one pair in ten
};

/// Largest number of rows in a submatrix for `kind_of_square`.
constexpr std::size_t kMostLookedAt = 64;
/// The tolerance for rounding errors, relative to the largest entry: on a diagonal, between the two
/// entries of a pair, and for entries below 0.
constexpr double kRounding = 1e-6;

/// @param block the entries of a principal submatrix, row by row, `side`^2 of them. A NaN on the
/// diagonal is ignored. Off the diagonal, it differs from every number, and equals another NaN.
SquareKind kind_of_square(std::span<const double> block, std::size_t side);

/// True if more than half of the entries off the diagonal are 0: this occurs in pictures, but never
/// in distances.
bool is_mostly_zero(std::span<const double> block, std::size_t side);

/// The shape of a table's rows, as far as they were read.
struct TableShape {
  /// The number of rows, counted up to one more than the number of columns; 0 if rows differ in
  /// length.
  std::size_t rows = 0;
  SquareKind square = SquareKind::nothing;  ///< nothing unless the table is square
  bool same_names = false;                  ///< the rows have the names of the columns
};
TableShape shape_of(const Input& input, const TableLayout& layout);

/// The meaning of an array, with the reason for a note.
struct ArrayGuess {
  ArrayMeaning meaning = ArrayMeaning::image;
  Message note;  ///< empty if there was no choice
};
/// The meaning of an NPY array if options.array does not state it.
/// @throws Error (bad_data) on an array that looks like correlations, because no meaning is safe.
ArrayGuess guess_array(const Input& input, const ReadOptions& options);

/// The format that a magic number or an extension indicates; empty for a text of numbers.
std::optional<Format> format_by_content(const Input& input);

/// For Input::open: refuses a stream that cannot have this format, because its magic number is
/// missing or because it is not text. If the format is automatic, a stream is refused if no format
/// can begin like it.
Input::StartCheck start_check(Format format);
/// For Input::open: refuses a stream that is not text and has no magic number.
Input::StartCheck start_check();

/// The content of a text of numbers without a magic number.
struct TextGuess {
  Format format = Format::points;
  std::size_t columns = 0;  ///< for a table
  TableShape table;
};
TextGuess guess_text(const Input& input, const ReadOptions& options);

/// A kind of file that this library recognises but does not read ("a JPEG picture"), with advice
/// for the user.
struct ForeignKind {
  std::string_view name;
  std::string_view advice;
};
/// Recognises a file by its first bytes, and STL also by its size; empty if it is unknown.
std::optional<ForeignKind> foreign_kind(std::string_view bytes);

/// @throws Error (bad_data) if the first bytes are not text in UTF-8. @param hint advice for bytes
/// of an unknown kind.
void require_text(const Input& input, std::string_view hint);

/// True if a file of this name may be a slice of a volume: a PNG, PGM or TIFF picture.
bool may_be_slice(std::string_view name);

/// @throws Error (usage) if options.columns were given for an input without columns to choose.
void refuse_columns(const ReadOptions& options, std::string_view found);

/// The option that requires a square matrix, for a message; empty if there is none.
std::string matrix_option(const ReadOptions& options);
/// The settings that read a square matrix as distances, for a message.
std::string way_to_distances(bool has_zero_diagonal);

}  // namespace ph::detail
