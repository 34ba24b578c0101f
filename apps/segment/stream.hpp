// SPDX-License-Identifier: MIT
#pragma once
#include "common/run/session.hpp"
#include "segment/arguments/arguments.hpp"

namespace ph::segment {

/// Segments frame after frame. One failure does not stop the others: its line goes to stderr and
/// the code of the first one is returned at the end. The last line on stderr is the throughput.
int run_stream(const Arguments& arguments, app::Session& session);

}  // namespace ph::segment
