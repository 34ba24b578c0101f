// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "ph/error.hpp"

namespace ph::test {

/// Checks that `act` throws an Error of this kind whose message has one line and contains `part`.
template <class Act>
void expect_error(ErrorKind kind, const std::string& part, Act&& act) {
  try {
    act();
  } catch (const Error& e) {
    const std::string message = e.what();
    EXPECT_EQ(e.kind(), kind) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return;
  }
  ADD_FAILURE() << "expected an error with '" << part << "', found none";
}

/// True if `act` throws an Error of this kind. An Error of another kind fails the test.
template <class Act>
bool fails_with(ErrorKind kind, Act&& act) {
  try {
    act();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.kind() == kind;
  }
  return false;
}

}  // namespace ph::test
