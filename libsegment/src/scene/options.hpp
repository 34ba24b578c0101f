// SPDX-License-Identifier: MIT
#pragma once
#include "ph/segment.hpp"

namespace ph::segment {

/// Checks a cloud and the options for it. @throws Error (usage), which names an option that is out
/// of its range; Error (bad_data) if the number of coordinates is not a multiple of three, or if
/// the number of points does not match the rows and columns.
void validate(const CloudView& cloud, const SegmentOptions& options);
/// Checks a scene. @throws Error (bad_data) unless its arrays have the lengths that it states, and
/// all indices in them exist.
void validate(const SceneTree& scene);
/// Checks a cut of a scene. @throws Error (bad_data) unless it has the points and vertices of the
/// scene.
void validate(const SceneTree& scene, const SceneCut& cut);
/// Checks a scene and options for cutting it. @throws Error (usage), which names an option that is
/// out of its range for this tree; Error (bad_data) like validate(scene).
void validate(const SceneTree& scene, const CutOptions& options);

}  // namespace ph::segment
