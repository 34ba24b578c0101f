// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <vector>

#include "tests/support/expect_error.hpp"

namespace ph::test {

/// A wrong value, and a part of the message about it.
struct Case {
  const char* name;
  ErrorKind kind;
  const char* part;
  std::function<void()> act;
};
inline void expect_errors(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    expect_error(c.kind, c.part, c.act);
  }
}

}  // namespace ph::test
