// SPDX-License-Identifier: MIT
#include "cubical/slabs/pair_in_slabs.hpp"

#include <cstdint>
#include <map>
#include <memory_resource>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "cubical/graphs/top_graph.hpp"
#include "cubical/graphs/two_graphs.hpp"
#include "cubical/graphs/voxel_graph.hpp"
#include "cubical/slabs/slab_basins.hpp"
#include "cubical/slabs/slab_loops.hpp"
#include "ph/error.hpp"

namespace ph::cubical {
namespace {

[[noreturn]] void refuse_loops(const GridFrame& frame) {
  throw Error(ErrorKind::resource,
              std::string("bars of dimension 1: what their critical cells take exceeds the memory "
                          "limit; ") +
                  (wants_loops(frame, {.min_dim = 2, .max_dim = 2})
                       ? "bars of dimension 0 fit (max_dim 0)"
                       : "all other dimensions fit (max_dim 0, or min_dim 2)"));
}

/// What is done while the critical cells of loops are there: without them it would fit.
template <class Run>
void with_loops(const GridFrame& frame, Run&& run) {
  try {
    run();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::resource) throw;
    refuse_loops(frame);
  } catch (const std::bad_alloc&) {
    refuse_loops(frame);
  }
}

/// A cell of a grid of fewer than 2^32 voxels.
NumberedCell numbered(const GridCell& cell) {
  return {static_cast<std::uint32_t>(cell.voxel()), cell.number()};
}

/// The edges of two axes that neither graph takes: around a torus two classes live for ever. Each
/// edge that is handed over by the graph of voxels as one that joins nothing is met by the graph of
/// top cells sooner or later, as one that joins something if it is in a pair.
class EdgesInNeither {
 public:
  explicit EdgesInNeither(std::pmr::memory_resource* memory) : met_once_(memory) {}
  void meet(double value, const NumberedCell& edge) {
    const auto [at, is_new] = met_once_.try_emplace({edge.voxel, edge.number}, value);
    if (!is_new) met_once_.erase(at);
  }
  void pair(PairSink& pairs) const {
    for (const auto& [edge, value] : met_once_)
      pairs.essential(1, {edge.first, kEdges[edge.second], value});
  }

 private:
  std::pmr::map<std::pair<std::uint32_t, std::uint32_t>, double> met_once_;
};

/// The components of one of the two graphs, slab by slab.
template <class Graph>
class SlabComponents {
 public:
  explicit SlabComponents(const RunContext& context) : context_(context) {}

  /// One more slab. @param first, cells as SlabBasins has them. @param use called with the forest
  /// of all that has been seen: settles it.
  template <class Use>
  void add(const StarGrid& grid, const Graph& graph, std::uint64_t first,
           const CriticalCells& cells, Use&& use) {
    auto own = SlabBasins<Graph>(grid, graph, first, context_).forest(cells);
    if (forest_)
      forest_->join(std::move(own));
    else
      forest_.emplace(std::move(own));
    if (grid.slab().is_last && grid.slab().is_in_ring) forest_->close_ring();
    use(*forest_);
  }

 private:
  const RunContext& context_;
  std::optional<SeamForest<Graph::kBackwards>> forest_;
};

}  // namespace

template <Field K>
void pair_in_slabs(Slabs& slabs, const K& field, const BarRequest& wanted,
                   const RunContext& context, PairSink& pairs) {
  const GridFrame& frame = slabs.frame();
  const int top = frame.top_dim();
  std::optional<SlabLoops> loops;
  if (wants_loops(frame, wanted)) loops.emplace(frame, context);
  const bool has_vertices = loops || wants_vertices(frame, wanted);
  const bool has_tops = loops || wants_top_cells(frame, wanted);
  SlabComponents<VoxelGraph> vertices(context);
  SlabComponents<TopGraph> tops(context);
  // Loops give way before there is no memory for the slabs and the other bars; their columns would
  // take more than they do.
  const std::size_t reserve = context.memory.left() / 2;
  std::optional<EdgesInNeither> around;
  if (top == 2 && frame.open_axes() == 0 && wanted.max_dim > 0) around.emplace(&context.memory);
  bool too_many_loops = false;

  const auto add_slab = [&](std::uint32_t slab) {
    const StarGrid grid = slabs.stars(slab);
    const std::uint64_t first = slabs.first_voxel(slab);
    std::optional<CriticalCells> edges;
    const auto edges_of_slab = [&]() -> const CriticalCells& {
      if (!edges) edges.emplace(critical_cells(grid, 1, context));
      return *edges;
    };
    if (has_vertices) {
      const auto cell = [](const SeamBridge& edge) {
        return StarCell{numbered(edge.cell).voxel, kEdges[edge.cell.number()], edge.value};
      };
      const auto voxel = [](const SeamRoot& root) {
        return StarCell{numbered(root.cell).voxel, {}, root.value};
      };
      vertices.add(grid, VoxelGraph(grid), first, edges_of_slab(), [&](auto& forest) {
        forest.settle(
            [&](const SeamBridge& edge, const SeamRoot* dies) {
              if (dies == nullptr)
                pairs.essential(1, cell(edge));
              else
                pairs.pair(0, voxel(*dies), cell(edge));
            },
            [&](const SeamBridge& edge) {
              if (loops) loops->add_edge(numbered(edge.cell));
              if (around) around->meet(edge.value, numbered(edge.cell));
            },
            [&](const SeamRoot& root) { pairs.essential(0, voxel(root)); });
      });
    }
    if (has_tops) {
      const TopGraph graph(grid);
      const auto cell = [&](const SeamBridge& facet) {
        return StarCell{numbered(facet.cell).voxel, graph.bridge_direction(facet.cell.number()),
                        facet.value};
      };
      const auto top_cell = [&](const SeamRoot& root) {
        return StarCell{numbered(root.cell).voxel, graph.root_direction(root.cell.number()),
                        root.value};
      };
      if (top == 3) edges.reset();
      const CriticalCells squares =
          top == 3 ? critical_cells(grid, 2, context) : CriticalCells(&context.memory);
      tops.add(grid, graph, first, top == 3 ? squares : edges_of_slab(), [&](auto& forest) {
        forest.settle(
            [&](const SeamBridge& facet, const SeamRoot* dies) {
              if (around) around->meet(facet.value, numbered(facet.cell));
              if (dies == nullptr)
                pairs.essential(top - 1, cell(facet));
              else
                pairs.pair(top - 1, cell(facet), top_cell(*dies));
            },
            [&](const SeamBridge& facet) {
              if (loops) loops->add_square(facet.value, numbered(facet.cell));
            },
            [&](const SeamRoot& root) { pairs.essential(top, top_cell(root)); });
      });
    }
    if (loops) loops->add_stars(grid, static_cast<std::uint32_t>(first));
    slabs.forget(slab);
  };
  for (std::uint32_t slab = 0; slab < slabs.count(); ++slab) {
    context.report({"slabs", slab, slabs.count()});
    if (loops)
      with_loops(frame, [&] { add_slab(slab); });
    else
      add_slab(slab);
    if (loops && context.memory.left() < reserve) {
      loops.reset();
      too_many_loops = true;
    }
  }
  if (around) around->pair(pairs);
  if (loops) with_loops(frame, [&] { loops->pair(field, pairs); });
  pairs.finish();
  if (too_many_loops) refuse_loops(frame);
}

template void pair_in_slabs(Slabs&, const Z2&, const BarRequest&, const RunContext&, PairSink&);
template void pair_in_slabs(Slabs&, const Zp&, const BarRequest&, const RunContext&, PairSink&);

}  // namespace ph::cubical
