// SPDX-License-Identifier: MIT
#pragma once
#include "common/manual/manual.hpp"

namespace ph::segment {

/// The manual of the program.
const app::Manual& manual();

}  // namespace ph::segment
