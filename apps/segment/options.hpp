// SPDX-License-Identifier: MIT
#pragma once
#include "ph/segment.hpp"

namespace ph::segment {

/// @throws Error (usage) naming the option that is out of its range; Error (bad_data) on a number
///         of coordinates that is no multiple of three.
void validate(const CloudView& cloud, const SegmentOptions& options);
/// @throws Error (usage) naming the option that is out of its range for this tree.
void validate(const SceneTree& scene, const CutOptions& options);

}  // namespace ph::segment
