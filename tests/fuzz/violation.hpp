// SPDX-License-Identifier: MIT
#pragma once
#include <stdexcept>
#include <string>

namespace ph::fuzz {

/// Thrown by a fuzz target if a property does not hold. libFuzzer does not catch the exception, so
/// it stops and stores the input. The replay reports the exception.
struct Violation : std::logic_error {
  using std::logic_error::logic_error;
};

inline void require(bool holds, const char* property) {
  if (!holds) throw Violation(property);
}

}  // namespace ph::fuzz
