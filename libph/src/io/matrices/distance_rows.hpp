// SPDX-License-Identifier: MIT
#pragma once
#include "libph/src/io/matrices/matrix_entry.hpp"

// This header contains code shared by square matrices and triangles of distances.

namespace ph::detail {

/// Returns n (n - 1) / 2. This is the number of pairs of n points, and also the position of d(n, 0)
/// in the rows of the lower triangle.
constexpr std::size_t triangle(std::size_t n) {
  return n % 2 == 0 ? n / 2 * (n - 1) : (n - 1) / 2 * n;
}

/// Depending on options.allow_empty, returns a matrix without points or throws an error.
DistanceMatrix no_points(const Input& input, const ReadOptions& options);

/// Allocates memory for the distances of all pairs of n points, after checking that the input is
/// long enough for `cells` cells. A cell may be empty, but takes at least one byte with its
/// separator.
/// @param first the number of cells in the first row. @param cells absent if the number exceeds 64
/// bits.
std::vector<double> make_triangle(const Input& input, std::size_t n, std::size_t first,
                                  std::optional<std::size_t> cells, const ReadOptions& options);

/// A part of an error message. It names the option that requires a square matrix, and a possible
/// cause of the problem.
std::string why_square(const ReadOptions& options);

[[noreturn]] void fail_row(const TextLines& lines, std::size_t row, std::size_t found,
                           std::size_t expected, std::string_view hint = {});

/// Reads entries of a text matrix, and checks each entry at its place.
class TextEntries {
 public:
  /// @param separator the character between two cells, as for Cells.
  TextEntries(const TextLines& lines, const ReadOptions& options, char separator = ' ');

  void start() { cells_.start(); }
  bool more() const { return cells_.more(); }
  std::string_view skip() { return cells_.skip(); }
  /// The place of the next entry.
  EntryPlace place(std::size_t row, std::size_t column) const;

  double next(const EntryPlace& place);
  /// Reads an entry that is not on the diagonal.
  double next() { return next(place(1, 0)); }
  /// Returns the distance for an empty last cell, which counts as NaN.
  double missing(const EntryPlace& place);
  double merged(double upper, double lower, const EntryPlace& place) {
    return entries_.merged(upper, lower, place);
  }
  /// Must be called after the last entry (see MatrixEntries::finish).
  void finish() const;

 private:
  double distance(double raw, const EntryPlace& place);

  const TextLines& lines_;
  const ReadOptions& options_;
  Cells cells_;
  MatrixEntries entries_;
};

}  // namespace ph::detail
