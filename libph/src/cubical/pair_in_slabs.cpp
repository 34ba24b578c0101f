// SPDX-License-Identifier: MIT
#include "pair_in_slabs.hpp"

#include <new>
#include <optional>
#include <tuple>

#include "loop_reduction.hpp"
#include "ph/core/error.hpp"
#include "ph/core/radix_sort.hpp"
#include "slab_components.hpp"
#include "star_bricks.hpp"
#include "top_graph.hpp"
#include "voxel_graph.hpp"

namespace ph::cubical {
namespace {

/// The critical edges and squares of three axes that neither graph takes, as they come.
class LoopCells {
 public:
  explicit LoopCells(const RunContext& context)
      : context_(context), edges_(&context.memory), squares_(&context.memory) {}

  void add_edge(const NumberedCell& edge) { edges_.push_back(edge); }
  void add_square(double value, const NumberedCell& square) { squares_.push_back({value, square}); }
  std::size_t count() const { return edges_.size() + squares_.size(); }

  FreeEdges free_edges(const GridFrame& frame) {
    std::ranges::sort(edges_, {}, &NumberedCell::voxel);
    FreeEdges free(frame, context_);
    for (std::size_t i = 0; i < edges_.size();) {
      const std::uint32_t v = edges_[i].voxel;
      unsigned numbers = 0;
      for (; i < edges_.size() && edges_[i].voxel == v; ++i) numbers |= 1U << edges_[i].number;
      free.add(v, numbers);
    }
    free.finish();
    edges_ = decltype(edges_)(&context_.memory);
    return free;
  }
  CriticalCells squares(const GridFrame& frame) {
    std::ranges::sort(squares_, {}, [&](const Square& square) {
      const auto [voxel, number] = square.cell;
      return std::tuple(voxel, frame.tables(voxel).square_order().rank(static_cast<int>(number)));
    });
    CriticalCells result(&context_.memory);
    result.cells.reserve(squares_.size());
    result.order.reserve(squares_.size());
    for (const auto& [value, cell] : squares_) {
      result.order.push_back({value, static_cast<std::uint32_t>(result.cells.size())});
      result.cells.push_back(cell);
    }
    squares_ = decltype(squares_)(&context_.memory);
    radix_sort_by_value(
        result.order, [](const CriticalCells::Place& place) { return place.value; }, context_);
    return result;
  }

 private:
  struct Square {
    double value;
    NumberedCell cell;
  };
  const RunContext& context_;
  std::pmr::vector<NumberedCell> edges_;
  std::pmr::vector<Square> squares_;
};

[[noreturn]] void refuse_loops() {
  throw Error(ErrorKind::resource,
              "bars of dimension 1: what their critical cells take exceeds the memory limit; all "
              "other dimensions fit");
}

template <Field K>
void pair_loops(const GridFrame& frame, LoopCells& cells, const K& field, const RunContext& context,
                PairSink& pairs) {
  try {
    const FreeEdges free = cells.free_edges(frame);
    const CriticalCells squares = cells.squares(frame);
    // The rest of what is left is for columns.
    const double bytes_of_bricks = static_cast<double>(context.memory.left()) / 3;
    StarBricks stars(frame, free, bytes_of_bricks, context);
    LoopReduction<K, StarBricks>(stars, free, squares, field, context, pairs).run();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::resource) throw;
    refuse_loops();
  } catch (const std::bad_alloc&) {
    refuse_loops();
  }
}

}  // namespace

template <Field K>
void pair_in_slabs(const Slabs& slabs, const K& field, int max_dim, const RunContext& context,
                   PairSink& pairs) {
  const GridFrame& frame = slabs.frame();
  const int top = frame.top_dim();
  const bool all = max_dim > 0;
  const bool wants_vertices = all || !frame.relative(), wants_tops = all || frame.relative();
  SlabComponents<VoxelGraph> vertices(context);
  SlabComponents<TopGraph> tops(context);
  std::optional<LoopCells> loops;
  if (all && top == 3) loops.emplace(context);
  // Loops give way before there is no memory for the slabs.
  const std::size_t reserve = context.memory.left() / 4;
  bool too_many_loops = false;

  for (std::uint32_t slab = 0; slab < slabs.count(); ++slab) {
    context.report({"slabs", slab, slabs.count()});
    const StarGrid grid = slabs.stars(slab);
    const std::uint32_t first = slabs.first_voxel(slab);
    std::optional<CriticalCells> edges;
    const auto edges_of_slab = [&]() -> const CriticalCells& {
      if (!edges) edges.emplace(critical_cells(grid, 1, context));
      return *edges;
    };
    if (wants_vertices) {
      using Place = SlabComponents<VoxelGraph>::Place;
      const auto cell = [](const Place& edge) {
        return StarCell{edge.cell.voxel, kEdges[edge.cell.number], edge.value};
      };
      const auto voxel = [](const SlabRoot& root) {
        return StarCell{root.cell.voxel, {}, root.value};
      };
      vertices.add(
          grid, VoxelGraph(grid), first, edges_of_slab(),
          [&](const Place& edge, const SlabRoot* dies) {
            if (dies == nullptr)
              pairs.essential(1, cell(edge));
            else
              pairs.pair(0, voxel(*dies), cell(edge));
          },
          [&](const Place& edge) {
            if (loops) loops->add_edge(edge.cell);
          },
          [&](const SlabRoot& root) { pairs.essential(0, voxel(root)); });
    }
    if (wants_tops) {
      using Place = SlabComponents<TopGraph>::Place;
      const TopGraph graph(grid);
      const auto cell = [&](const Place& facet) {
        return StarCell{facet.cell.voxel, graph.bridge_direction(facet.cell.number), facet.value};
      };
      const auto top_cell = [&](const SlabRoot& root) {
        return StarCell{root.cell.voxel, graph.root_direction(root.cell.number), root.value};
      };
      if (top == 3) edges.reset();
      const CriticalCells squares =
          top == 3 ? critical_cells(grid, 2, context) : CriticalCells(&context.memory);
      tops.add(
          grid, graph, first, top == 3 ? squares : edges_of_slab(),
          [&](const Place& facet, const SlabRoot* dies) {
            if (dies == nullptr)
              pairs.essential(top - 1, cell(facet));
            else
              pairs.pair(top - 1, cell(facet), top_cell(*dies));
          },
          [&](const Place& facet) {
            if (loops) loops->add_square(facet.value, facet.cell);
          },
          [&](const SlabRoot& root) { pairs.essential(top, top_cell(root)); });
    }
    slabs.forget(slab);
    if (loops && context.memory.left() < reserve) {
      loops.reset();
      too_many_loops = true;
    }
  }
  if (loops) pair_loops(frame, *loops, field, context, pairs);
  pairs.finish();
  if (too_many_loops) refuse_loops();
}

template void pair_in_slabs(const Slabs&, const Z2&, int, const RunContext&, PairSink&);
template void pair_in_slabs(const Slabs&, const Zp&, int, const RunContext&, PairSink&);

}  // namespace ph::cubical
