// SPDX-License-Identifier: MIT
#pragma once
#include "ph/barcode.hpp"
#include "ph/merge_tree.hpp"

namespace ph::segment {

/// The barcode of H0 that a merge tree stands for: a bar a vertex, zero-length bars included.
Barcode barcode_of(const MergeTree& tree);

}  // namespace ph::segment
