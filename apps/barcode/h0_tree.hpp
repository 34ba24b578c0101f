// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "report.hpp"
#include "report/tree_arrays.hpp"

namespace ph::barcode {

/// The merge tree of what was computed, as a report holds it.
struct ShownTree {
  MergeTree tree;
  report::ContractedTree contracted;
  report::LinkedBars bars;
  report::TreeMeta meta;
};

/// Nothing where the vertices of the complex are not those of the input (a sample, an
/// approximation, corners between voxels) or where there are too many of them.
/// @throws Error (resource, cancelled).
std::optional<ShownTree> h0_tree(const Shown& shown, const Arguments& arguments,
                                 const RunContext& context);

}  // namespace ph::barcode
