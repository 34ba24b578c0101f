// SPDX-License-Identifier: MIT
#pragma once
#include "common/run/session.hpp"
#include "segment/arguments/arguments.hpp"

namespace ph::segment {

/// Reads what --camera names, and says what is not in plain sight: nominal values, a lens.
/// @throws Error as ph::read_camera does.
void load_camera(DepthInput& image, app::Session& session);

}  // namespace ph::segment
