// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <cstdlib>

namespace ph::test {

/// A time limit of a test. The environment variable PH_TEST_PATIENCE multiplies it, for example by
/// 10 if an emulator runs the tests.
inline std::chrono::duration<double> patience(double seconds) {
  const char* times = std::getenv("PH_TEST_PATIENCE");
  return std::chrono::duration<double>(times ? seconds * std::atof(times) : seconds);
}

}  // namespace ph::test
