// SPDX-License-Identifier: MIT
#pragma once
#include "ph/barcode.hpp"
#include "ph/io/write.hpp"
#include "ph/merge_tree.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// The barcode of H0 that a merge tree represents: one bar per vertex, including zero-length bars.
Barcode barcode_of(const MergeTree& tree);

/// The origin of a segmentation's barcode, without program and input.
BarcodeInfo info_of_barcode(const Segmentation& segmentation);

}  // namespace ph::segment
