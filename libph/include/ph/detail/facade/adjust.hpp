// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

#include "ph/detail/core/loop.hpp"
#include "ph/merge_tree.hpp"
#include "ph/persistence.hpp"
#include "ph/points.hpp"

namespace ph {

/// The barcode with its vertices renamed to points of an input from which some points were left
/// out: vertex v becomes ids[v]. The bars keep their places. Precondition: the ids ascend.
/// @throws Error (usage) if the cells have no vertices, or vertices without an id.
Barcode with_input_ids(const Barcode& barcode, const std::vector<Index>& ids);
/// Renames the vertices of loops in the same way. @throws Error (usage) on a vertex without an id.
void name_points(std::vector<BarLoops>& loops, const std::vector<Index>& ids);

/// The place of each bar: the mean of the cells of its representative, where the place of a cell is
/// the mean of its vertices. NaN for a bar without cells, and for a bar of H0, because its cycle
/// joins a vertex to a vertex of an older component.
/// @param points the points that the vertices number. @return one row per bar.
/// @throws Error (usage) if the bars have no representatives, or if a cell is not made of these
/// points; Error (resource) on lack of memory.
Points centroids(const Barcode& barcode, PointsView points,
                 const RunContext& context = default_context());

/// The tree with vertex v renamed to ids[v], one of the `size` vertices of the input. The input's
/// other vertices never enter. Precondition: there is one id per vertex, below `size`.
MergeTree with_input_ids(MergeTree tree, std::span<const Index> ids, std::size_t size);

/// The barcode of the subcomplex of all cells up to a value: a bar born after `threshold` is left
/// out, and a bar that dies after it never dies. Cocycles are restricted to the subcomplex.
/// @param barcode the barcode of the whole complex, with all bars of positive length.
/// @param min_persistence bars that die in the subcomplex and are no longer than this are left out.
Barcode cut_at(const Barcode& barcode, const ExplicitComplex& complex, double threshold,
               double min_persistence);

}  // namespace ph
