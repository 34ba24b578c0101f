// SPDX-License-Identifier: MIT
#pragma once
#include "common/run/session.hpp"
#include "segment/arguments/arguments.hpp"

namespace ph::segment {

/// Reads the camera that --camera names, and reports anything not obvious: nominal values, a lens.
/// @throws Error like ph::read_camera.
void load_camera(DepthInput& image, app::Session& session);

}  // namespace ph::segment
