// SPDX-License-Identifier: MIT
#pragma once
#include <stdexcept>
#include <string>

namespace ph::fuzz {

/// Thrown by a fuzz target if a property does not hold. libFuzzer does not catch it, and stops with
/// the input; the replay reports it.
struct Violation : std::logic_error {
  using std::logic_error::logic_error;
};

inline void require(bool holds, const char* property) {
  if (!holds) throw Violation(property);
}

}  // namespace ph::fuzz
