// SPDX-License-Identifier: MIT
#include "cubical/slabs/layer_pairs.hpp"

#include <utility>

#include "cubical/graphs/top_graph.hpp"
#include "cubical/graphs/voxel_graph.hpp"
#include "cubical/slabs/slab_basins.hpp"
#include "ph/error.hpp"

namespace ph::cubical {
LayerPairs::LayerPairs(const GridShape& grid, const Graphs& graphs, const RunContext& context)
    : around(&context.memory),
      grid_(grid),
      graphs_(graphs),
      may_have_neither_(grid.top_dim() == 2 && grid.open_axes() == 0 && graphs.vertices &&
                        graphs.tops),
      context_(context) {}

template <class Forest>
void LayerPairs::take(std::optional<Forest>& all, Forest next, bool comes_before) {
  if (all && comes_before) {
    next.join(std::move(*all));
    all.emplace(std::move(next));
  } else if (all) {
    all->join(std::move(next));
  } else {
    all.emplace(std::move(next));
  }
  if (is_ring() && has_begin && has_end) all->close_ring();
}

void LayerPairs::add(const StarGrid& slab, std::uint64_t first, PairSink& pairs,
                     FreeCellSink* free) {
  has_begin = has_begin || slab.slab().is_first;
  has_end = has_end || slab.slab().is_last;
  std::optional<CriticalCells> edges;
  const auto edges_of_slab = [&]() -> const CriticalCells& {
    if (!edges) edges.emplace(critical_cells(slab, 1, context_));
    return *edges;
  };
  if (graphs_.vertices) {
    const VoxelGraph graph(slab);
    if (vertices) vertices->after.forget_values();
    auto forest =
        SlabBasins(slab, graph, first, vertices.has_value(), context_).forest(edges_of_slab());
    take(vertices, std::move(forest));
    settle_vertices(pairs, free);
  }
  if (graphs_.tops) {
    const TopGraph graph(slab);
    if (grid_.top_dim() == 3) edges.reset();
    const CriticalCells squares =
        grid_.top_dim() == 3 ? critical_cells(slab, 2, context_) : CriticalCells(&context_.memory);
    if (tops) tops->after.forget_values();
    auto forest = SlabBasins(slab, graph, first, tops.has_value(), context_)
                      .forest(grid_.top_dim() == 3 ? squares : edges_of_slab());
    take(tops, std::move(forest));
    settle_tops(pairs, free);
  }
}

void LayerPairs::check_seams(const LayerPairs& others, bool come_before) const {
  const bool closes = is_ring() && (has_begin || others.has_begin) && (has_end || others.has_end);
  const auto agree = [&](const auto& mine, const auto& theirs) {
    if (!mine) return true;
    const auto &first = come_before ? *theirs : *mine, &last = come_before ? *mine : *theirs;
    return first.is_before(last) && (!closes || last.is_before(first));
  };
  if (!agree(vertices, others.vertices) || !agree(tops, others.tops))
    throw Error(ErrorKind::bad_data,
                "parts of an image: found seams that differ, expected layers that follow each "
                "other");
}

void LayerPairs::join(LayerPairs others, bool come_before, PairSink& pairs, FreeCellSink* free) {
  check_seams(others, come_before);
  has_begin = has_begin || others.has_begin;
  has_end = has_end || others.has_end;
  around.join(others.around);
  if (graphs_.vertices) {
    take(vertices, std::move(*others.vertices), come_before);
    settle_vertices(pairs, free);
  }
  if (graphs_.tops) {
    take(tops, std::move(*others.tops), come_before);
    settle_tops(pairs, free);
  }
}

void LayerPairs::finish(PairSink& pairs) const {
  for (const auto& [edge, value] : around.met_once)
    pairs.essential(1, WholeCell{edge.voxel(), kEdges[edge.number()], value});
}

void LayerPairs::settle_vertices(PairSink& pairs, FreeCellSink* free) {
  const auto edge = [](const SeamBridge& bridge) {
    return WholeCell{bridge.cell.voxel(), kEdges[bridge.cell.number()], bridge.value};
  };
  const auto voxel = [](const SeamRoot& root) {
    return WholeCell{root.cell.voxel(), {}, root.value};
  };
  vertices->settle(
      [&](const SeamBridge& bridge, const SeamRoot* dies) {
        if (dies == nullptr)
          pairs.essential(1, edge(bridge));
        else
          pairs.pair(0, voxel(*dies), edge(bridge));
      },
      [&](const SeamBridge& bridge) {
        if (free != nullptr) free->add_edge(bridge.cell);
        if (may_have_neither_) around.meet(bridge.value, bridge.cell);
      },
      [&](const SeamRoot& root) { pairs.essential(0, voxel(root)); });
}

void LayerPairs::settle_tops(PairSink& pairs, FreeCellSink* free) {
  const int top = grid_.top_dim();
  const auto facet = [top](const SeamBridge& bridge) {
    const std::uint32_t n = bridge.cell.number();
    return WholeCell{bridge.cell.voxel(), top == 3 ? kSquares[n] : kEdges[n], bridge.value};
  };
  const auto top_cell = [top](const SeamRoot& root) {
    const std::uint32_t n = root.cell.number();
    return WholeCell{root.cell.voxel(), top == 3 ? kCubes[n] : kSquares[n], root.value};
  };
  tops->settle(
      [&](const SeamBridge& bridge, const SeamRoot* dies) {
        if (may_have_neither_) around.meet(bridge.value, bridge.cell);
        if (dies == nullptr)
          pairs.essential(top - 1, facet(bridge));
        else
          pairs.pair(top - 1, facet(bridge), top_cell(*dies));
      },
      [&](const SeamBridge& bridge) {
        if (free != nullptr) free->add_square(bridge.value, bridge.cell);
      },
      [&](const SeamRoot& root) { pairs.essential(top, top_cell(root)); });
}

}  // namespace ph::cubical
