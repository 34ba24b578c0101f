// SPDX-License-Identifier: MIT
#pragma once
#include "ph/segment.hpp"

namespace ph::segment {

/// @throws Error (usage) naming the option that is out of its range; Error (bad_data) on a number
///         of coordinates that is no multiple of three.
void validate(const CloudView& cloud, const SegmentOptions& options);
/// @throws Error (bad_data) unless the arrays of the scene are as long as they say, and what they
///         number is there.
void validate(const SceneTree& scene);
/// @throws Error (bad_data) unless the cut has the points and vertices of the scene.
void validate(const SceneTree& scene, const SceneCut& cut);
/// @throws Error (usage) naming the option that is out of its range for this tree; Error (bad_data)
///         as above.
void validate(const SceneTree& scene, const CutOptions& options);

}  // namespace ph::segment
