// SPDX-License-Identifier: MIT
#pragma once
#include "common/manual/manual.hpp"

namespace ph::distance_program {

/// What ph-distance says of itself.
const app::Manual& manual();

}  // namespace ph::distance_program
