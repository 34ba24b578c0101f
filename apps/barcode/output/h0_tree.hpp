// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "barcode/output/report.hpp"
#include "report/arrays/tree_arrays.hpp"

namespace ph::barcode {

inline constexpr std::size_t kMostTreeVoxels = 1 << 22;  ///< all cells of an image are listed

/// The merge tree of what was computed, as a report holds it.
struct ShownTree {
  MergeTree tree;
  report::ContractedTree contracted;
  report::LinkedBars bars;
  report::TreeMeta meta;
};

/// The merge tree of a complex. Nothing where its vertices are not those of the input (a sample, an
/// approximation, corners between voxels) or where there are too many of them.
/// @throws Error (resource, cancelled).
std::optional<MergeTree> whole_tree(const BuiltComplex& built, const NamedData& data,
                                    const Arguments& arguments, const RunContext& context);
/// The same with all that a page needs; nothing where there is none.
std::optional<ShownTree> h0_tree(const Shown& shown, const Arguments& arguments,
                                 const RunContext& context);

}  // namespace ph::barcode
