// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "libph/src/cubical/grid/cell_grid.hpp"
#include "ph/detail/components/disjoint_sets.hpp"

namespace ph::cubical {

/// Persistent components in one of a grid's two graphs. The first graph has vertices, joined by
/// edges in the order in which the edges enter. The second graph has top cells, joined by facets in
/// reverse order, youngest first. The second graph also has nodes that were always there. They are
/// cells that never enter, and the outside, which has two parts if only one axis has ends. Pairs of
/// cells within a star (arrows) give the nodes their first parents. Bridges then join components by
/// the elder rule.
class CellComponents {
 public:
  using Name = CellGrid::Name;
  enum class Graph { of_vertices, of_top_cells };

  /// Allocates 4 bytes per node.
  CellComponents(const CellGrid& grid, Graph graph, const RunContext& context);

  /// Joins components across bridges, in the order of the graph.
  /// @param bridges edges or facets that are in no known pair, in the order of the filtration; the
  /// function removes the bridges that join components.
  /// @param on_merge called with (bridge, node that dies); the node is nothing if both components
  /// were always there.
  void join(std::pmr::vector<Name>& bridges,
            const std::function<void(Name, std::optional<Name>)>& on_merge);
  /// True if the component born with a node without an arrow lives forever. Precondition: `join`
  /// has been called.
  bool survives(Name node);

 private:
  // The number of the node that contains these coordinates; the two parts of the outside come last.
  std::uint32_t number(const CellGrid::Coordinates& x) const;
  std::uint32_t cell_of(std::uint32_t number) const;
  /// The node that is `steps` steps away from a cell in a direction. Two steps lead from a node to
  /// the next node; one step leads from a bridge to a node.
  std::uint32_t beyond(std::uint32_t cell, const CellGrid::Coordinates& x, int direction,
                       int steps) const;
  std::array<std::uint32_t, 2> ends(std::uint32_t bridge) const;
  /// The name of a node, or nothing if the node was always there.
  std::optional<Name> name_of(std::uint32_t node) const;
  void follow_arrows();
  void join_what_never_enters();

  const CellGrid& grid_;
  const bool backwards_;
  const RunContext& context_;
  int open_axes_ = 0;
  std::uint32_t count_ = 1;
  DisjointSets sets_;
};

}  // namespace ph::cubical
