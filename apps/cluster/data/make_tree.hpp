// SPDX-License-Identifier: MIT
#pragma once
#include "apps/cluster/arguments/arguments.hpp"
#include "apps/cluster/data/load.hpp"
#include "ph/cluster_tree.hpp"

namespace ph::cluster {

/// The number of neighbours for core distances. The default is one less than the fewest points of a
/// cluster, or all other points if there are fewer of them, because then there are no clusters.
/// @throws Error (usage) if more neighbours are requested than there are other points.
Index neighbours_of(const Arguments& arguments, Index points);

/// The cluster tree of mutual reachability distances. A point that has too few neighbours at finite
/// distances has no core distance, and is never joined.
/// @throws Error like Rips and ClusterTree, with the name of the input if the data are the reason.
ClusterTree make_tree(const Loaded& loaded, const Arguments& arguments, Index neighbours,
                      const RunContext& context);

}  // namespace ph::cluster
