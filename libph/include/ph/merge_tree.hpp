// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <vector>

#include "ph/detail/complex/filtered_graph.hpp"
#include "ph/detail/components/branch.hpp"
#include "ph/filtration.hpp"
#include "ph/run_context.hpp"

namespace ph {

class Rips;
class Cubical;
class Alpha;
class ExplicitComplex;

/// Two components become one. The elder component survives. It is the component that was born
/// first; among equals, it is the component whose oldest vertex comes first in the order of the
/// filtration (in a Rips filtration, the vertex with the smaller number).
struct Merge {
  double value = 0;        ///< filtration value of the edge
  Index u = 0, v = 0;      ///< the edge that joined them: an edge of a minimum spanning forest
  Index elder = 0;         ///< vertex that gave birth to the surviving component
  Index younger = 0;       ///< vertex that gave birth to the component that dies here
  Index elder_size = 0;    ///< vertices of the surviving component just before the merge
  Index younger_size = 0;  ///< vertices of the dying component just before the merge
  double elder_birth = 0;  ///< filtration values at which the two components were born
  double younger_birth = 0;

  double persistence() const { return value == younger_birth ? 0 : value - younger_birth; }
  /// True if both components are significant, by size and by the persistence of the younger one.
  bool separates(double min_persistence, Index min_size) const {
    return persistence() >= min_persistence && std::min(elder_size, younger_size) >= min_size;
  }
  friend bool operator==(const Merge&, const Merge&) = default;
};

/// H0 as a tree: how the components of the sublevel sets join as the value grows. For points under
/// the Rips filtration, this is the single-linkage dendrogram, and the pairs (u, v) are the edges
/// of a minimum spanning tree (Gower & Ross 1969). With Euclidean distances, finding this tree
/// takes near-linear time for millions of points.
struct MergeTree {
  std::vector<double> births;  ///< one per vertex; kInfinity for a vertex that never enters
  std::vector<Merge> merges;   ///< in the order of the filtration

  Index size() const { return static_cast<Index>(births.size()); }
  /// For each vertex, the vertex that gave birth to its component in the sublevel set of `value`
  /// (after all merges at values <= value); -1 for a vertex that has not entered.
  std::vector<Index> components(double value) const;
  /// Performs all merges except merges that separate two basins (see Merge::separates). Returns,
  /// for each vertex, a vertex that stands for its entire basin; -1 for a vertex that never enters.
  /// A vertex belongs to the side from which the spanning forest reaches it, which makes a basin
  /// grow until it meets another one, as in ToMATo (Chazal, Guibas, Oudot & Skraba 2013).
  /// O(vertices) per call.
  std::vector<Index> basins(double min_persistence, Index min_size = 1) const;
  /// A class of H0: the component that a vertex gave birth to, until it merges into an older
  /// component.
  struct Class {
    double birth, death;
    Index vertex;
    Index merge;  ///< position in `merges` of the merge in which it dies; -1 if it never dies
  };
  /// All classes, including classes of length zero, by (birth, death, vertex): the order of a
  /// barcode.
  std::vector<Class> classes() const;
  /// The same classes as branches, in the order of the vertices that gave birth to them.
  std::vector<Branch> branches() const;
  /// True if all births and all merges are equal, in the same order.
  friend bool operator==(const MergeTree&, const MergeTree&) = default;
};

/// A row of a linkage matrix: two clusters become one. Clusters 0 … n-1 are the vertices; row i
/// makes cluster n + i.
struct LinkageRow {
  Index first = 0, second = 0;  ///< the clusters, the smaller number first
  double value = 0;             ///< filtration value at which they join
  Index size = 0;               ///< vertices of the new cluster
  friend bool operator==(const LinkageRow&, const LinkageRow&) = default;
};
/// The merges in the form that software for hierarchical clustering uses (for example SciPy's
/// `cluster.hierarchy`): one row per merge, in order; n - 1 rows if everything becomes one cluster.
std::vector<LinkageRow> linkage(const MergeTree& tree);

/// The merge tree of a filtration. Vertices are numbered as in the input: points, voxels in C order
/// (V-construction; grid corners in the T-construction), vertices of a complex in input order. For
/// a Rips filtration without approximation, a spanning forest is made instead of all edges.
/// @throws Error (usage) on a Rips filtration whose vertices are not all points (some were chosen,
///         equal points were to be merged, or births lie beyond the threshold); on an Alpha of a
///         periodic space.
MergeTree merge_tree(const Rips& rips, const RunContext& context = default_context());
MergeTree merge_tree(const Cubical& cubical, const RunContext& context = default_context());
MergeTree merge_tree(const Alpha& alpha, const RunContext& context = default_context());
MergeTree merge_tree(const FilteredGraph& graph, const RunContext& context = default_context());
/// @throws Error (usage) if an edge does not join two vertices.
MergeTree merge_tree(const ExplicitComplex& complex, const RunContext& context = default_context());

}  // namespace ph
