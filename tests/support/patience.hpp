// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <cstdlib>

namespace ph::test {

/// A time that a test allows. The environment variable PH_TEST_PATIENCE multiplies it, as in 10
/// where an emulator runs the tests.
inline std::chrono::duration<double> patience(double seconds) {
  const char* times = std::getenv("PH_TEST_PATIENCE");
  return std::chrono::duration<double>(times ? seconds * std::atof(times) : seconds);
}

}  // namespace ph::test
