// SPDX-License-Identifier: MIT
#pragma once
#include "ph/barcode.hpp"
#include "ph/io/write.hpp"
#include "ph/merge_tree.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// The barcode of H0 that a merge tree stands for: a bar a vertex, zero-length bars included.
Barcode barcode_of(const MergeTree& tree);

/// Where the barcode of a segmentation came from; program and input are not said.
BarcodeInfo info_of_barcode(const Segmentation& segmentation);

}  // namespace ph::segment
