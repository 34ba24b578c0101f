// SPDX-License-Identifier: MIT
#pragma once
#include "ph/segment.hpp"

namespace ph::segment {

/// @throws Error (usage) naming the option that is out of its range; Error (bad_data) if the number
///         of coordinates is not a multiple of three.
void validate(const CloudView& cloud, const SegmentOptions& options);
/// @throws Error (bad_data) unless the arrays of the scene have the lengths that it states, and all
///         indices in them exist.
void validate(const SceneTree& scene);
/// @throws Error (bad_data) unless the cut has the points and vertices of the scene.
void validate(const SceneTree& scene, const SceneCut& cut);
/// @throws Error (usage) naming the option that is out of its range for this tree; Error (bad_data)
///         as above.
void validate(const SceneTree& scene, const CutOptions& options);

}  // namespace ph::segment
