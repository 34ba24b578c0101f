// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <functional>
#include <utility>

#include "ph/io/read.hpp"

namespace ph::detail {

/// Where a number of a matrix stands.
struct EntryPlace {
  std::size_t row = 0, column = 0;
  std::size_t byte = 0;  ///< of the input; 0 where the numbers were unpacked first
};

/// Takes the numbers of a matrix for distances. What is small beside the largest of them is
/// rounding: a diagonal, an entry below zero, the difference between the two entries of a pair.
/// Which it is, is known only when all numbers were seen.
class MatrixEntries {
 public:
  explicit MatrixEntries(const ReadOptions& options) : options_(options) {}

  /// The distance that a number means: 1 - r of a correlation; +infinity of NaN; 0 of what is below
  /// 0, for now. Calls `fail(fault)`, which does not return, if it means none whatever the others
  /// are.
  template <class Fail>
  double distance(double raw, const EntryPlace& place, Fail&& fail) {
    const bool on_diagonal = place.row == place.column;
    if (raw >= 0 && !options_.from_correlation && !on_diagonal) {  // as a rule
      look_at(raw);
      return raw;
    }
    if (Fault fault = fault_of(raw, on_diagonal); !fault.what.empty()) fail(std::move(fault));
    return distance_of(raw, place);
  }
  /// One distance from the two of a pair. @param place of the lower one.
  double merged(double upper, double lower, const EntryPlace& place);

  /// After the last number: calls `fail(place, fault)`, which throws, if something was more than
  /// rounding; else says what was taken as 0.
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
  std::array<Doubt, 3> worst_ = {};  // by kind
};

/// Fails at the line and column of a byte.
[[noreturn]] void fail_in_text(const Input& input, std::size_t byte, const Fault& fault);

}  // namespace ph::detail
