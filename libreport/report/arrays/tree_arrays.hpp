// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ph/detail/report/report_file.hpp"
#include "ph/detail/report/shown_tree.hpp"

namespace ph::report {

/// Contracts the merges that every cut of the page performs. The vertices that these merges join
/// form a leaf.
/// @param rule, from the page cuts by this rule, at `from` or above.
/// @param min_part used by the rule `persistence`. A merge is kept only if each of its components
/// has at least this number of vertices.
/// @param points the number of points of each vertex; empty if each vertex is one point. Takes
/// O(vertices) time.
ContractedTree contracted(const MergeTree& tree, CutRule rule, double from, Index min_part,
                          std::span<const std::uint32_t> points, const RunContext& context);

/// The least level at which a cut lets contracted() keep at most `most` merges. If more merges than
/// that have the largest level, a cut by persistence keeps all of them.
double least_cut(const MergeTree& tree, CutRule rule, std::size_t most);

/// Finds the bar of H0 that dies in each merge. Bars and merges are matched by birth and death. If
/// several bars or merges have the same values, they are matched in the order of their birth
/// vertices.
/// @param birth_vertices the birth vertex of each bar.
LinkedBars linked_bars(const MergeTree& tree, const Barcode& barcode,
                       std::span<const std::uint32_t> birth_vertices);

/// Writes the arrays tree/… that every merge tree has.
void add_tree(ReportFile& report, const MergeTree& tree, const ContractedTree& contracted,
              const LinkedBars& bars, CutRule rule);

/// Pairs of leaves that are adjacent in the picture that a camera took. Each pair occurs once, with
/// the smaller leaf first. One leaf is to the right of the other or below it, and at most a few
/// pixels without a leaf are between them. Gaps of such pixels occur where one thing hides another.
/// In space, the leaves may be far apart.
/// @param index the pixel of each point, counted row by row, ascending.
/// @param leaf the leaf of each point; kNone if the point has no leaf. @param width the width of
/// the picture, > 0. Takes O(n log n) time.
std::vector<std::uint32_t> touching_in_picture(std::span<const std::uint32_t> index,
                                               std::span<const std::uint32_t> leaf,
                                               std::size_t width);

}  // namespace ph::report
