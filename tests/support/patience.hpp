// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <cstdlib>

namespace ph::test {

/// A time limit of a test, multiplied by the environment variable PH_TEST_PATIENCE. For tests that
/// run in an emulator, the variable may be 10, for example.
inline std::chrono::duration<double> patience(double seconds) {
  const char* times = std::getenv("PH_TEST_PATIENCE");
  return std::chrono::duration<double>(times ? seconds * std::atof(times) : seconds);
}

}  // namespace ph::test
