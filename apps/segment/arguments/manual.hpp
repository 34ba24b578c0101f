// SPDX-License-Identifier: MIT
#pragma once
#include "common/manual/manual.hpp"

namespace ph::segment {

/// What the program says of itself beside its options.
const app::Manual& manual();

}  // namespace ph::segment
