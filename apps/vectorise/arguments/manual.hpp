// SPDX-License-Identifier: MIT
#pragma once
#include "common/manual/manual.hpp"

namespace ph::vectorise {

/// The manual of ph-vectorise.
const app::Manual& manual();

}  // namespace ph::vectorise
