// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <vector>

#include "ph/io/read.hpp"

// What is what in a table: names, an index, numbers; and what a square one may be.

namespace ph::detail {

/// Where the numbers of a text table are.
struct TableLayout {
  std::vector<std::string> header = {};   ///< names of the columns, on the first line; empty: none
  std::size_t width = 0;                  ///< cells of the first row; 0: there is none
  std::vector<std::size_t> columns = {};  ///< those that hold numbers to be read, ascending
  bool names_rows = false;                ///< columns before them are an index of the rows
  std::vector<Message> notes = {};        ///< what was assumed
  char separator = ' ';                   ///< of the first row: ',', ';', a tab, or blanks
  bool keeps_tabs = false;                ///< each tab separates two cells

  /// How many columns lead the others and have no name though there is a header.
  std::size_t unnamed() const;
  /// The lines of the table, before the first one.
  TextLines lines(const Input& input) const;
  /// Whether column k is one of `columns`, for all k < width.
  std::vector<bool> taken() const;
  /// Goes to the first row, behind the header. @return whether there is one.
  bool start(TextLines& lines) const;
  /// Tells options.note the notes.
  void tell(const ReadOptions& options) const;
};

/// Looks at the first lines and, where they leave it open, at the first column. A first column is
/// left out if it has no name, or if it is an index by name (id, index, …) and counts the rows.
/// @throws Error (usage) if options.columns names what is not there.
TableLayout table_layout(const Input& input, const ReadOptions& options);

/// The number that a cell holds, NaN if double cannot hold it; nothing if it holds no number.
std::optional<double> number_in(std::string_view cell);
/// Whether a cell is NA or #N/A, as R and spreadsheets write a value that is not there.
bool is_missing_value(std::string_view cell);
/// A cell without the double quotes around it.
std::string_view without_quotes(std::string_view cell);
/// Cells of a line of names, without the quotes around them, without an empty last one, and without
/// two slashes before the first.
/// @param names_only nothing if one is a number, or empty.
/// @param keeps_tabs each tab separates two cells, else any number of them.
std::vector<std::string> header_cells(std::string_view line, bool names_only,
                                      bool keeps_tabs = false);
/// What separates the cells of a line: a comma, a semicolon or a tab outside of quotes, the first
/// of these that there is, else blanks.
char separator_in(std::string_view line);
/// Cells of the current line, without an empty last one. @param separator see Cells.
std::size_t count_cells(const TextLines& lines, char separator = ' ');
/// Whether a line ends in a separator: its last cell is empty if another one is expected.
bool ends_empty(std::string_view line);

/// What to do about a cell of a table that is no number.
CellHints cell_hints(const ReadOptions& options);

/// The columns that a list of names and numbers from 1 ("x", "3", "2-5") stands for, ascending.
/// @param header may be empty. @throws Error (usage) on one that is not there, stands twice, is
/// the name of several columns, or the name of one and the number of another: of "2-2" there is
/// one meaning.
std::vector<std::size_t> chosen_columns(const std::vector<std::string>& wanted,
                                        const std::vector<std::string>& header, std::size_t width,
                                        const Input& input);

/// What a square table of numbers looks like.
enum class SquareKind {
  nothing,              ///< no symmetric matrix
  zeros,                ///< a diagonal of zeros, but not symmetric, or with negative entries
  distances,            ///< symmetric, not negative, with a diagonal of zeros
  correlations,         ///< symmetric, from -1 to 1, with a diagonal of ones
  symmetric,            ///< symmetric only
  nearly_correlations,  ///< the same but for one pair of ten at most, or for little
  nearly_symmetric,     ///< symmetric but for one pair of ten at most
};

/// Most rows of a submatrix that `kind_of_square` is asked about.
constexpr std::size_t kMostLookedAt = 64;
/// Rounding, relative to the largest entry: of a diagonal, of the two entries of a pair, and of
/// what is below 0.
constexpr double kRounding = 1e-6;

/// @param block the entries of a principal submatrix, row by row, `side`^2 of them. NaN fits all.
SquareKind kind_of_square(std::span<const double> block, std::size_t side);

/// Whether more than half of what is not on the diagonal is 0: of pictures, never of distances.
bool is_mostly_zero(std::span<const double> block, std::size_t side);

/// What the rows of a table are, as far as was looked.
struct TableShape {
  /// Counted up to one more than columns; 0 if they differ in length.
  std::size_t rows = 0;
  SquareKind square = SquareKind::nothing;  ///< of a square table
  bool same_names = false;                  ///< its rows have the names of its columns
};
TableShape shape_of(const Input& input, const TableLayout& layout);

/// Why an array is taken for what it is taken for: for a note.
struct ArrayGuess {
  ArrayMeaning meaning = ArrayMeaning::image;
  Message note;  ///< empty: there was no choice
};
/// What an NPY array holds, where options.array leaves it open.
/// @throws Error (bad_data) on what looks like correlations: no meaning is safe.
ArrayGuess guess_array(const Input& input, const ReadOptions& options);

/// What a magic number or an extension says; nothing of a text of numbers.
std::optional<Format> format_by_content(const Input& input);

/// What a text of numbers without a magic number holds.
struct TextGuess {
  Format format = Format::points;
  std::size_t columns = 0;  ///< of a table
  TableShape table;
};
TextGuess guess_text(const Input& input, const ReadOptions& options);

/// "a JPEG picture" and what to do with it, for files that this library knows but does not read.
struct ForeignKind {
  std::string_view name;
  std::string_view advice;
};
/// By the first bytes of a file, of STL also by its size; nothing if it is not known.
std::optional<ForeignKind> foreign_kind(std::string_view bytes);

/// @throws Error (usage) if options.columns were given for what has none to choose.
void refuse_columns(const ReadOptions& options, std::string_view found);

/// What of the options asks for a square matrix, for a message; empty: nothing.
std::string matrix_option(const ReadOptions& options);
/// The settings with which a square matrix is read as distances, for a message.
std::string way_to_distances(bool has_zero_diagonal);

}  // namespace ph::detail
