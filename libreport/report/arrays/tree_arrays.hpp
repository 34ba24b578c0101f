// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/merge_tree.hpp"
#include "report/metadata.hpp"
#include "report/report_file.hpp"

namespace ph::report {

inline constexpr std::uint32_t kNone = UINT32_MAX;  ///< no leaf, no bar

/// A merge tree without what no cut takes apart: vertices that are together in every cut are one
/// leaf. Leaves are numbered by their smallest vertex.
struct ContractedTree {
  std::vector<std::uint32_t> leaf_of;  ///< by vertex; kNone for one that never enters
  std::vector<double> leaf_birth;      ///< least birth of its vertices
  std::vector<std::uint32_t> leaf_points, leaf_vertices;  ///< how many there are
  struct KeptMerge {
    std::size_t merge;  ///< its place in MergeTree::merges
    /// The leaves of the ends of its edge, the one in the component of Merge::younger first.
    std::uint32_t younger, elder;
  };
  std::vector<KeptMerge> merges;  ///< in the order of the tree
};

/// @param rule, from cuts of `from` and more will be made, by this rule.
/// @param min_part rule persistence: fewest vertices of both components of a merge that is kept.
/// @param points of each vertex; empty: one each. O(vertices).
ContractedTree contracted(const MergeTree& tree, CutRule rule, double from, Index min_part,
                          std::span<const std::uint32_t> points, const RunContext& context);

/// The least cut for which no more than `most` merges are kept: above the levels of all the others.
double least_cut(const MergeTree& tree, CutRule rule, std::size_t most);

/// Which bar of H0 dies in each merge: bars and merges of the same values, in the order of their
/// birth vertices, which decides among equals only. @param vertex_of a birth cell: its vertex.
struct LinkedBars {
  std::vector<std::uint32_t> of_merge;   ///< by place in MergeTree::merges; kNone: no such bar
  std::vector<std::uint32_t> of_vertex;  ///< by vertex: the infinite bar that was born in it
};
LinkedBars linked_bars(const MergeTree& tree, const Barcode& barcode,
                       std::span<const std::uint32_t> birth_vertices);

/// Writes the arrays tree/…, except joins.
void add_tree(ReportFile& report, const MergeTree& tree, const ContractedTree& contracted,
              const LinkedBars& bars, CutRule rule);

}  // namespace ph::report
