// SPDX-License-Identifier: MIT
#pragma once
// The graphs of a Rips filtration, for tests that examine edges.
#include <utility>

#include "ph/detail/rips/rips_filtration.hpp"
#include "ph/persistence.hpp"

namespace ph::test {

/// The graph of all edges, in which equal points are separate vertices.
inline const RipsGraph& all_edges(const Rips& rips) { return rips.graph(RipsForm::edges); }

/// The graph that a computation with these options uses.
inline const RipsGraph& planned_graph(const Rips& rips, const Options& options) {
  return rips.graph(*plan(rips, options).form);
}

/// Calls `use` with the filtration of all edges, which may be dense, sparse or wide.
template <class Use>
decltype(auto) with_all_edges(const Rips& rips, int max_dim, Use&& use) {
  return with_rips_filtration(all_edges(rips), max_dim, std::forward<Use>(use));
}

/// The same filtration, in which equal points are separate vertices.
inline Rips without_merging(const Rips& rips) {
  RipsOptions options = rips.options();
  options.merge_equal_points = false;
  return rips.with(std::move(options));
}

}  // namespace ph::test
