// SPDX-License-Identifier: MIT
#pragma once
#include <utility>

#include "ph/io/read.hpp"

namespace ph::detail {

/// What is wrong with a number of a matrix; `what` is empty if nothing is. Whether a diagonal is
/// zero is not seen here: it depends on the other entries.
Fault fault_of_entry(double raw, bool on_diagonal, const ReadOptions& options);
/// The distance that a faultless number means: 1 - r of a correlation; +infinity of NaN.
double distance_of_entry(double raw, bool on_diagonal, const ReadOptions& options);

/// The distance that a number of a matrix means. Calls `fail(fault)`, which does not return, if it
/// means none.
template <class Fail>
double checked_distance(double raw, bool on_diagonal, const ReadOptions& options, Fail&& fail) {
  if (raw >= 0 && !options.from_correlation && !on_diagonal) return raw;  // as a rule
  if (Fault fault = fault_of_entry(raw, on_diagonal, options); !fault.what.empty())
    fail(std::move(fault));
  return distance_of_entry(raw, on_diagonal, options);
}

}  // namespace ph::detail
