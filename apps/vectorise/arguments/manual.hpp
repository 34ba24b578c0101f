// SPDX-License-Identifier: MIT
#pragma once
#include "common/manual/manual.hpp"

namespace ph::vectorise {

/// What ph-vectorise says of itself.
const app::Manual& manual();

}  // namespace ph::vectorise
