// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ph/detail/report/report_file.hpp"
#include "ph/detail/report/shown_tree.hpp"

namespace ph::report {

/// @param rule, from the page cuts by this rule, at `from` or more.
/// @param min_part for rule persistence: fewest vertices of both components of a merge that is
///     kept.
/// @param points number of points of each vertex; empty: one each. O(vertices).
ContractedTree contracted(const MergeTree& tree, CutRule rule, double from, Index min_part,
                          std::span<const std::uint32_t> points, const RunContext& context);

/// The least cut for which at most `most` merges are kept: it lies above the levels of all others.
double least_cut(const MergeTree& tree, CutRule rule, std::size_t most);

/// The bar of H0 that dies in each merge: bars and merges are matched by value, and equal ones by
/// the order of their birth vertices. @param birth_vertices the birth vertex of each bar.
LinkedBars linked_bars(const MergeTree& tree, const Barcode& barcode,
                       std::span<const std::uint32_t> birth_vertices);

/// Writes the arrays tree/… that every merge tree has.
void add_tree(ReportFile& report, const MergeTree& tree, const ContractedTree& contracted,
              const LinkedBars& bars, CutRule rule);

/// Pairs of leaves that are adjacent in the picture that a camera took, each pair once with the
/// smaller leaf first. One leaf is to the right of the other or below it, with at most a few pixels
/// without a leaf in between, as occur where one thing hides another. In space, such leaves may be
/// far apart.
/// @param index the pixel of each point, counted row by row, ascending. @param leaf the leaf of
///     each point; kNone: none.
/// @param width of the picture, > 0. O(n log n).
std::vector<std::uint32_t> touching_in_picture(std::span<const std::uint32_t> index,
                                               std::span<const std::uint32_t> leaf,
                                               std::size_t width);

}  // namespace ph::report
