// SPDX-License-Identifier: MIT
#pragma once
// Segmentations as plain values and arrays: for pickle.
#include <pybind11/pybind11.h>

#include "data/arrays.hpp"
#include "run.hpp"
#include "scenes/scene.hpp"

namespace ph::python {

/// The tree and its cut, as their file has them: equal for equal trees and cuts.
Block tree_file(const SegmentedScene& scene);

/// That, and the cloud. The segments are found again from the tree; how long stages took is not
/// kept.
pybind11::dict state_of(const SegmentedScene& scene);
/// @throws Error (bad_data) on what cannot be such a state.
SegmentedScene scene_of_state(const pybind11::dict& state, const RunOptions& options);

/// What a stored tree says of a scene, and its first cut.
segment::Segmentation segmentation_of_tree(const Input& tree, const RunContext& context);

}  // namespace ph::python
