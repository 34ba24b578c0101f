// SPDX-License-Identifier: MIT
#include "ph/cubical/two_graphs.hpp"

#include <algorithm>
#include <optional>

#include "ph/cubical/arrow_forest.hpp"
#include "ph/cubical/merge_labels.hpp"
#include "ph/cubical/top_graph.hpp"

namespace ph::cubical {
namespace {

/// Voxels, and what has always been there: the outside, in two parts where one axis alone has
/// ends.
class VoxelGraph {
 public:
  explicit VoxelGraph(const StarGrid& grid) : grid_(grid) {}

  std::size_t size() const { return std::size_t{grid_.size()} + 2; }
  std::uint32_t outside(int part) const { return grid_.size() + static_cast<std::uint32_t>(part); }
  std::uint32_t beside(std::uint32_t v, int edge) const {
    return or_outside(grid_.step(v, axis_of_edge(edge), sign_of(edge)), edge);
  }
  /// Across an edge of the star of v.
  std::uint32_t across(std::uint32_t v, int edge) const {
    return or_outside(grid_.step_in_star(v, edge), edge);
  }
  std::uint32_t arrow(std::uint32_t v) const {
    return across(v, grid_.tables(v).arrow(grid_.star(v)));
  }

 private:
  static int sign_of(int edge) { return kEdges[edge][axis_of_edge(edge)]; }
  std::uint32_t or_outside(std::uint32_t u, int edge) const {
    if (u != StarGrid::kOutside) return u;
    return outside(grid_.open_axes() == 1 && sign_of(edge) > 0 ? 1 : 0);
  }

  const StarGrid& grid_;
};

/// Labels of what has always been there; united as far as it hangs together.
class EndlessLabels {
 public:
  explicit EndlessLabels(std::pmr::memory_resource* memory) : united_(memory) {}

  std::uint32_t add() { return count_++; }
  void unite(std::uint32_t a, std::uint32_t b) { united_.emplace_back(a, b); }
  std::uint32_t size() const { return count_; }
  /// The sets of these labels and of others behind them.
  DisjointSets sets(std::size_t others, std::pmr::memory_resource* memory) const {
    DisjointSets all(count_ + others, memory);
    for (auto [a, b] : united_) {
      a = all.find(a);
      b = all.find(b);
      if (a != b) all.link(std::max(a, b), std::min(a, b));
    }
    return all;
  }

 private:
  std::uint32_t count_ = 0;
  std::pmr::vector<std::pair<std::uint32_t, std::uint32_t>> united_;
};

/// Calls `use(number)` for the bits of a set in the order of `at(rank)`.
template <class At, class Use>
void for_each_in_order(unsigned set, int count, At&& at, Use&& use) {
  if (set == 0) return;
  for (int rank = 0; rank < count; ++rank)
    if (const int number = at(rank); (set >> number & 1U) != 0) use(number);
}

void mark_edge(StarGrid& grid, const Bridge& bridge) {
  const std::uint32_t v = bridge.voxel;
  grid.mark(v, grid.tables(v).taken_mark(static_cast<int>(bridge.number)));
}

}  // namespace

void pair_vertices_with_edges(StarGrid& grid, const RunContext& context, const PairSink& sink) {
  const VoxelGraph graph(grid);
  ArrowForest<VoxelGraph> forest(graph, graph.size(), &context.memory);
  EndlessLabels endless(&context.memory);
  for (const int part : {0, 1}) forest.set_label(graph.outside(part), endless.add());
  if (grid.relative() && !grid.all_enter()) {
    Ticker ticker(context, "holes", grid.size());
    for (std::uint32_t v = 0; v < grid.size(); ++v) {
      ticker.tick();
      if (grid.enters(v)) continue;
      forest.set_label(v, endless.add());
      for (int e = 0; e < kEdgeCount; ++e) {
        if (!grid.has_axis(axis_of_edge(e))) continue;
        if (const std::uint32_t u = graph.beside(v, e); forest.has_label(u))
          endless.unite(forest.label(u), forest.label(v));
      }
    }
  }
  std::pmr::vector<Root> roots(&context.memory);
  std::pmr::vector<Bridge> bridges(&context.memory);
  for (const std::uint32_t v : grid.critical())
    if (StarTables::edges(grid.star(v)) == 0) roots.push_back({grid.value(v), v, 0});
  for (std::size_t i = 0; i < roots.size(); ++i)
    forest.set_label(roots[i].voxel, static_cast<std::uint32_t>(endless.size() + i));
  const bool wants_loops = grid.top_dim() == 1;
  Ticker ticker(context, "basins", grid.critical().size());
  for (const std::uint32_t v : grid.critical()) {
    ticker.tick();
    const StarTables& tables = grid.tables(v);
    for_each_in_order(
        tables.critical_edges(grid.star(v)), kEdgeCount,
        [&](int rank) { return tables.edge_at(rank); },
        [&](int e) {
          const std::uint32_t a = forest.label(v), b = forest.label(graph.across(v, e));
          if (a != b || wants_loops)
            bridges.push_back({grid.value(v), a, b, v, static_cast<std::uint32_t>(e)});
        });
  }
  const auto edge_of = [&](const Bridge& b) { return StarCell{b.voxel, kEdges[b.number]}; };
  LabelMerger merger(endless.sets(roots.size(), &context.memory), endless.size(), roots, bridges,
                     false, context);
  merger.run(
      [&](const Bridge& bridge, const Root* dies) {
        if (grid.wants_marks()) mark_edge(grid, bridge);
        if (dies == nullptr)
          sink.essential(1, edge_of(bridge));
        else if (dies->value != bridge.value)
          sink.pair(0, {dies->voxel, {}}, edge_of(bridge));
      },
      [&](const Bridge& bridge) {
        if (wants_loops) sink.essential(1, edge_of(bridge));
      },
      [&](const Root& root) {
        sink.essential(0, {root.voxel, {}});
      });
}

TakenSquares pair_facets_with_top_cells(StarGrid& grid, const RunContext& context,
                                        const PairSink& sink) {
  const int top = grid.top_dim();
  const TopGraph graph(grid);
  ArrowForest<TopGraph> forest(graph, graph.size(), &context.memory);
  EndlessLabels endless(&context.memory);
  for (const int part : {0, 1}) forest.set_label(graph.outside(part), endless.add());
  if (!grid.relative() && !grid.all_enter()) {
    Ticker ticker(context, "holes", grid.size());
    for (std::uint32_t v = 0; v < grid.size(); ++v) {
      ticker.tick();
      if (grid.enters(v)) continue;
      // Top cells around a voxel that never enters hang together.
      std::optional<std::uint32_t> first;
      graph.for_each_around(v, [&](std::uint32_t node) {
        if (!forest.has_label(node)) forest.set_label(node, endless.add());
        const std::uint32_t label = forest.label(node);
        if (first) endless.unite(*first, label);
        first = label;
      });
    }
  }
  std::pmr::vector<Root> roots(&context.memory);
  std::pmr::vector<Bridge> bridges(&context.memory);
  const auto cell_direction = [top](std::uint32_t n) { return top == 3 ? kCubes[n] : kSquares[n]; };
  const auto facet_direction = [top](std::uint32_t n) {
    return top == 3 ? kSquares[n] : kEdges[n];
  };
  for (const std::uint32_t v : grid.critical()) {
    const std::uint32_t star = grid.star(v);
    const StarTables& tables = grid.tables(v);
    const auto add = [&](int number) {
      roots.push_back({grid.value(v), v, static_cast<std::uint32_t>(number)});
    };
    if (top == 3 && StarTables::cubes(star) == 255)
      for_each_in_order(
          tables.pair_cubes(star).critical_cubes(), kCubeCount,
          [&](int rank) { return tables.cube_at(rank); }, add);
    if (top == 2)
      for_each_in_order(
          tables.critical_squares(star, {}), kSquareCount,
          [&](int rank) { return tables.square_at(rank); }, add);
  }
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const Root& root = roots[i];
    forest.set_label(graph.node(root.voxel, cell_direction(root.number)),
                     static_cast<std::uint32_t>(endless.size() + i));
  }
  Ticker ticker(context, "basins", grid.critical().size());
  for (const std::uint32_t v : grid.critical()) {
    ticker.tick();
    const std::uint32_t star = grid.star(v);
    const StarTables& tables = grid.tables(v);
    const auto add = [&](int number) {
      const auto n = static_cast<std::uint32_t>(number);
      const Direction d = facet_direction(n);
      const int normal = top == 3 ? normal_of_square(number) : 3 - axis_of_edge(number);
      const std::uint32_t a = forest.label(graph.node(v, turned(d, normal, -1))),
                          b = forest.label(graph.node(v, turned(d, normal, 1)));
      if (a != b) bridges.push_back({grid.value(v), a, b, v, n});
    };
    if (top == 3)
      for_each_in_order(
          tables.critical_squares(star, tables.pair_cubes(star)), kSquareCount,
          [&](int rank) { return tables.square_at(rank); }, add);
    else
      for_each_in_order(
          tables.critical_edges(star), kEdgeCount, [&](int rank) { return tables.edge_at(rank); },
          add);
  }
  TakenSquares taken(top == 3 ? grid.critical().size() : 0, 0, &context.memory);
  const auto facet_of = [&](const Bridge& b) {
    return StarCell{b.voxel, facet_direction(b.number)};
  };
  const auto cell_of = [&](const Root& root) {
    return StarCell{root.voxel, cell_direction(root.number)};
  };
  LabelMerger merger(endless.sets(roots.size(), &context.memory), endless.size(), roots, bridges,
                     true, context);
  merger.run(
      [&](const Bridge& bridge, const Root* dies) {
        if (top == 3) {
          const auto critical = grid.critical();
          const auto at = std::lower_bound(critical.begin(), critical.end(), bridge.voxel);
          taken[static_cast<std::size_t>(at - critical.begin())] |=
              static_cast<std::uint16_t>(1U << bridge.number);
        } else if (grid.wants_marks()) {
          mark_edge(grid, bridge);
        }
        if (dies == nullptr)
          sink.essential(top - 1, facet_of(bridge));
        else if (dies->value != bridge.value)
          sink.pair(top - 1, facet_of(bridge), cell_of(*dies));
      },
      [](const Bridge&) {}, [&](const Root& root) { sink.essential(top, cell_of(root)); });
  return taken;
}

}  // namespace ph::cubical
