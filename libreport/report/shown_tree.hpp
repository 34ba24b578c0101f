// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include "ph/persistence.hpp"
#include "report/arrays/tree_arrays.hpp"

namespace ph::report {

inline constexpr std::size_t kMostTreeVoxels = 1 << 22;  ///< all cells of an image are listed

/// A merge tree with all that a page needs to show it.
struct ShownTree {
  MergeTree tree;
  ContractedTree contracted;
  LinkedBars bars;
  TreeMeta meta;
};

/// The merge tree of a complex. Nothing where its vertices are not those of the input (points that
/// are no vertices, corners between voxels), or where there are too many of them.
/// @throws Error (resource, cancelled).
std::optional<MergeTree> whole_tree(const AnyComplex& complex, const RunContext& context);

/// @param tree of the complex that `barcode` is of.
/// @throws Error (resource, cancelled).
ShownTree shown_tree(MergeTree tree, const Barcode& barcode, const AnyComplex& complex,
                     const RunContext& context);

}  // namespace ph::report
