// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <functional>
#include <utility>

#include "ph/io/read.hpp"

namespace ph::detail {

/// The place of a number in a matrix.
struct EntryPlace {
  std::size_t row = 0, column = 0;
  std::size_t byte = 0;  ///< the offset in the input; 0 if the numbers were unpacked first
};

/// Converts the numbers of a matrix to distances. A number on the diagonal, a negative number, or
/// the difference between the two entries of a pair counts as a rounding error if it is small
/// compared with the largest distance. This can be decided only after all numbers have been seen.
class MatrixEntries {
 public:
  explicit MatrixEntries(const ReadOptions& options) : options_(options) {}

  /// The distance for a number. The distance is 1 - r for a correlation r, +infinity for NaN, and 0
  /// for negative numbers, which finish() checks. Calls `fail(fault)`, which does not return, if
  /// the number can never be valid.
  template <class Fail>
  double distance(double raw, const EntryPlace& place, Fail&& fail) {
    const bool on_diagonal = place.row == place.column;
    // mutant: guess-sparse
    if (raw >= 0 && !options_.from_correlation && !on_diagonal) {  // this is the usual case
      look_at(raw);
      return raw;
    }
    if (Fault fault = fault_of(raw, on_diagonal); !fault.what.empty()) fail(std::move(fault));
    return distance_of(raw, place);
  }
  /// Combines the two entries of a pair into one distance. @param place the place of the lower
  /// entry.
  double merged(double upper, double lower, const EntryPlace& place);

  /// Must be called after the last number. If rounding does not explain the error of a number,
  /// calls `fail(place, fault)`, which throws. Otherwise notes the numbers that were taken as 0.
  void finish(const std::function<void(const EntryPlace&, const Fault&)>& fail) const;

 private:
  enum Kind { kNegative, kAsymmetric, kDiagonal };
  struct Doubt {
    double size = 0;
    double value = 0, other = 0;
    EntryPlace place;
  };

  void look_at(double distance);
  void doubt(Kind kind, const Doubt& doubt);
  Fault fault_of(double raw, bool on_diagonal) const;
  double distance_of(double raw, const EntryPlace& place);
  double rounding() const;
  Fault fault_of(Kind kind, const Doubt& doubt) const;

  const ReadOptions& options_;
  double largest_ = 0;
  std::array<Doubt, 3> worst_ = {};  // the largest doubt of each kind
};

/// Fails at the line and column of a byte.
[[noreturn]] void fail_in_text(const Input& input, std::size_t byte, const Fault& fault);

}  // namespace ph::detail
