// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ph/detail/report/shown_tree.hpp"
#include "report/report_file.hpp"

namespace ph::report {

/// @param rule, from cuts of `from` and more will be made, by this rule.
/// @param min_part rule persistence: fewest vertices of both components of a merge that is kept.
/// @param points of each vertex; empty: one each. O(vertices).
ContractedTree contracted(const MergeTree& tree, CutRule rule, double from, Index min_part,
                          std::span<const std::uint32_t> points, const RunContext& context);

/// The least cut for which no more than `most` merges are kept: above the levels of all the others.
double least_cut(const MergeTree& tree, CutRule rule, std::size_t most);

/// Which bar of H0 dies in each merge: bars and merges of the same values, in the order of their
/// birth vertices, which decides among equals only. @param vertex_of a birth cell: its vertex.
LinkedBars linked_bars(const MergeTree& tree, const Barcode& barcode,
                       std::span<const std::uint32_t> birth_vertices);

/// Writes the arrays tree/… that any merge tree has.
void add_tree(ReportFile& report, const MergeTree& tree, const ContractedTree& contracted,
              const LinkedBars& bars, CutRule rule);

}  // namespace ph::report
