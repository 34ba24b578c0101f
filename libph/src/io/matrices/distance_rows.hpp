// SPDX-License-Identifier: MIT
#pragma once
#include "io/matrices/matrix_entry.hpp"

// What square matrices and triangles of distances have in common.

namespace ph::detail {

/// n (n - 1) / 2: the pairs of n points, and the place of d(n, 0) among them.
constexpr std::size_t triangle(std::size_t n) {
  return n % 2 == 0 ? n / 2 * (n - 1) : (n - 1) / 2 * n;
}

/// A matrix of no points, or an error, as options.allow_empty says.
DistanceMatrix no_points(const Input& input, const ReadOptions& options);

/// Memory for all pairs of n points, once the bytes that are there were found to be enough for
/// `cells` cells, of which empty ones take a byte. @param first cells of the first row.
std::vector<double> make_triangle(const Input& input, std::size_t n, std::size_t first,
                                  std::optional<std::size_t> cells, const ReadOptions& options);

/// The option that asked for a square matrix, and what may have happened.
std::string why_square(const ReadOptions& options);

[[noreturn]] void fail_row(const TextLines& lines, std::size_t row, std::size_t found,
                           std::size_t expected, std::string_view hint = {});

/// Reads entries of a text matrix, each checked where it stands.
class TextEntries {
 public:
  /// @param separator see Cells.
  TextEntries(const TextLines& lines, const ReadOptions& options, char separator = ' ');

  void start() { cells_.start(); }
  bool more() const { return cells_.more(); }
  std::string_view skip() { return cells_.skip(); }
  /// Where the next one stands.
  EntryPlace place(std::size_t row, std::size_t column) const;

  double next(const EntryPlace& place);
  /// One that is not on the diagonal.
  double next() { return next(place(1, 0)); }
  /// An empty last cell, where that means NaN.
  double missing(const EntryPlace& place);
  double merged(double upper, double lower, const EntryPlace& place) {
    return entries_.merged(upper, lower, place);
  }
  /// After the last one; see MatrixEntries.
  void finish() const;

 private:
  double distance(double raw, const EntryPlace& place);

  const TextLines& lines_;
  const ReadOptions& options_;
  Cells cells_;
  MatrixEntries entries_;
};

}  // namespace ph::detail
