// SPDX-License-Identifier: MIT
#pragma once
#include "common/manual/manual.hpp"

namespace ph::distance_program {

/// The manual of ph-distance.
const app::Manual& manual();

}  // namespace ph::distance_program
