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

inline constexpr std::uint32_t kNone = UINT32_MAX;  ///< stands for no leaf or no bar

/// The largest image with a tree. A larger image has no tree, because the tree would need a list of
/// all cells.
inline constexpr std::size_t kMostTreeVoxels = 1 << 22;

/// The rule that decides which merges a cut performs.
enum class CutRule {
  persistence,  ///< merges with a persistence below the cut: MergeTree::basins
  value,        ///< merges at values up to the cut: MergeTree::components
};

struct TreeMeta {
  CutRule rule = CutRule::persistence;
  std::string label, unit = {};
  double cut = 0;                    ///< cut that the page shows first
  double from = 0;                   ///< least cut for which the contraction is correct
  std::optional<double> to = {};     ///< largest such cut, if there is one
  Index min_size = 1;                ///< fewest vertices of a segment
  std::string what;                  ///< the word for a part on the page, such as "segment"
  std::vector<std::string> command;  ///< command for another cut, "{cut}" standing for its value
};

/// A merge tree in which all vertices that no cut can separate are contracted to one leaf. Leaves
/// are numbered by their smallest vertex.
struct ContractedTree {
  std::vector<std::uint32_t> leaf_of;  ///< leaf of each vertex; kNone if it never enters
  std::vector<double> leaf_birth;      ///< for each leaf, the least birth of its vertices
  /// For each leaf, the number of its points and the number of its vertices.
  std::vector<std::uint32_t> leaf_points, leaf_vertices;
  struct KeptMerge {
    std::size_t merge;  ///< its place in MergeTree::merges
    /// The leaves at the ends of its edge; the leaf in the component of Merge::younger comes first.
    std::uint32_t younger, elder;
  };
  std::vector<KeptMerge> merges;  ///< in the order of the tree
};

/// The bar of H0 that dies in each merge, and the bars that never die.
struct LinkedBars {
  std::vector<std::uint32_t> of_merge;   ///< by index into MergeTree::merges; kNone: no such bar
  std::vector<std::uint32_t> of_vertex;  ///< by vertex: the infinite bar that was born in it
};

/// A merge tree with all the data that a page needs to show it.
struct ShownTree {
  MergeTree tree;
  ContractedTree contracted;
  LinkedBars bars;
  TreeMeta meta;
};

/// The merge tree of a complex. Empty if its vertices do not correspond to the input (some points
/// are not vertices, or vertices are corners between voxels), if listed cells have a threshold, if
/// an alpha complex is periodic, or if an image has too many voxels.
/// @throws Error (resource, cancelled).
std::optional<MergeTree> whole_tree(const AnyComplex& complex, const RunContext& context);

/// @param tree the merge tree of the complex to which `barcode` belongs.
/// @throws Error (resource, cancelled).
ShownTree shown_tree(MergeTree tree, const Barcode& barcode, const AnyComplex& complex,
                     const RunContext& context);

}  // namespace ph::report
