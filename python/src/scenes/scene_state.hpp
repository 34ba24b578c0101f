// SPDX-License-Identifier: MIT
#pragma once
// This header converts segmentations to plain values and arrays, and back, for pickle.
#include <pybind11/pybind11.h>

#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/scenes/scene.hpp"

namespace ph::python {

/// The tree and its cut, as bytes of a file. The bytes are equal for equal trees and cuts.
Block tree_file(const SegmentedScene& scene);

/// The tree, its cut and the cloud, as plain values and arrays. The segments are recomputed from
/// the tree. The times of stages are not kept.
pybind11::dict state_of(const SegmentedScene& scene);
/// @throws Error (bad_data) on an invalid state.
SegmentedScene scene_of_state(const pybind11::dict& state, const RunOptions& options);

/// The description of a scene in a stored tree, and its first cut.
segment::Segmentation segmentation_of_tree(const Input& tree, const RunContext& context);

}  // namespace ph::python
