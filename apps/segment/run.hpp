// SPDX-License-Identifier: MIT
#pragma once
#include <stop_token>

namespace ph::segment {

/// The program: reads, segments, writes. @return its exit code. @throws Error.
int run(int argc, const char* const* argv, std::stop_token stop);

}  // namespace ph::segment
