// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ph/merge_tree.hpp"
#include "ph/persistence.hpp"

namespace ph::report {

inline constexpr std::uint32_t kNone = UINT32_MAX;  ///< no leaf, no bar

inline constexpr std::size_t kMostTreeVoxels = 1 << 22;  ///< all cells of an image are listed

/// What decides which merges a cut does.
enum class CutRule {
  persistence,  ///< those of a persistence below the cut: MergeTree::basins
  value,        ///< those at values up to the cut: MergeTree::components
};

struct TreeMeta {
  CutRule rule = CutRule::persistence;
  std::string label, unit = {};
  double cut = 0;                    ///< where the page begins
  double from = 0;                   ///< least cut for which the contraction is right
  std::optional<double> to = {};     ///< largest one
  Index min_size = 1;                ///< fewest vertices of a segment
  std::string what;                  ///< "segment"
  std::vector<std::string> command;  ///< of another cut, "{cut}" standing for its value
};

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

/// Which bar of H0 dies in each merge, and which one never dies.
struct LinkedBars {
  std::vector<std::uint32_t> of_merge;   ///< by place in MergeTree::merges; kNone: no such bar
  std::vector<std::uint32_t> of_vertex;  ///< by vertex: the infinite bar that was born in it
};

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
