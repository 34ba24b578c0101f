// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include "barcode/arguments/arguments.hpp"
#include "barcode/complex/build_complex.hpp"
#include "barcode/complex/read_input.hpp"
#include "ph/merge_tree.hpp"

namespace ph::barcode {

/// The merge tree of what was computed. Nothing where the complex was sampled, approximated or cut,
/// and where report::whole_tree has none.
/// @throws Error (resource, cancelled).
std::optional<MergeTree> whole_tree(const BuiltComplex& built, const NamedData& data,
                                    const Arguments& arguments, const RunContext& context);

}  // namespace ph::barcode
