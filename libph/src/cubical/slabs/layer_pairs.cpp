// SPDX-License-Identifier: MIT
#include "libph/src/cubical/slabs/layer_pairs.hpp"

#include <utility>

#include "libph/src/cubical/graphs/top_graph.hpp"
#include "libph/src/cubical/graphs/voxel_graph.hpp"
#include "libph/src/cubical/layers/layer_graphs.hpp"
#include "libph/src/cubical/slabs/slab_basins.hpp"
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
  if (is_ring() && has_begin && has_end) all->close_ring();  // mutant: part-ring
}

template <class Forest, class Grid, class Graph>
void LayerPairs::take_slab(std::optional<Forest>& all, const Grid& slab, const Graph& graph,
                           const CriticalCells& bridges, std::uint64_t first) {
  if (all) all->after.forget_values();
  take(all, SlabBasins(slab, graph, first, all.has_value(), context_).forest(bridges));
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
    take_slab(vertices, slab, VoxelGraph(slab), edges_of_slab(), first);
    settle_vertices(pairs, free);
  }
  if (graphs_.tops) {
    if (grid_.top_dim() == 3) edges.reset();
    const CriticalCells squares =
        grid_.top_dim() == 3 ? critical_cells(slab, 2, context_) : CriticalCells(&context_.memory);
    take_slab(tops, slab, TopGraph(slab), grid_.top_dim() == 3 ? squares : edges_of_slab(), first);
    settle_tops(pairs, free);
  }
}

void LayerPairs::add(const LayerGrid& slab, std::uint64_t first, PairSink& pairs) {
  has_begin = has_begin || slab.slab().is_first;
  has_end = has_end || slab.slab().is_last;
  if (graphs_.vertices) {
    const LayerVoxelGraph graph(slab, context_);
    take_slab(vertices, slab, graph, graph.links().bridges, first);
    settle_vertices(pairs, nullptr);
  }
  if (graphs_.tops) {
    const LayerTopGraph graph(slab, context_);
    take_slab(tops, slab, graph, graph.links().bridges, first);
    settle_tops(pairs, nullptr);
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
                "parts of an image: found layers that do not match where parts meet, expected "
                "parts of one image");
}

void LayerPairs::join(LayerPairs others, bool come_before, PairSink& pairs, FreeCellSink* free) {
  check_seams(others, come_before);
  has_begin = has_begin || others.has_begin;
  has_end = has_end || others.has_end;
  around.join(others.around);  // mutant: part-edges-left
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
  for (const auto& [edge, value] : around.met_once) pairs.essential(1, cell(1, edge, value));
}

void LayerPairs::settle_vertices(PairSink& pairs, FreeCellSink* free) {
  const auto edge = [this](const SeamBridge& b) { return cell(1, b.cell, b.value); };
  const auto voxel = [this](const SeamRoot& root) { return cell(0, root.cell, root.value); };
  vertices->settle(
      [&](const SeamBridge& bridge, const SeamRoot* dies) {
        if (dies == nullptr)
          pairs.essential(1, edge(bridge));
        else
          pairs.pair(0, voxel(*dies), edge(bridge));
      },
      [&](const SeamBridge& bridge) {
        // This edge closes a cycle.
        // mutant: slab-circle
        if (grid_.top_dim() == 1) pairs.essential(1, edge(bridge));
        if (free != nullptr) free->add_edge(bridge.cell);
        if (may_have_neither_) around.meet(bridge.value, bridge.cell);
      },
      [&](const SeamRoot& root) { pairs.essential(0, voxel(root)); });
}

void LayerPairs::settle_tops(PairSink& pairs, FreeCellSink* free) {
  const int top = grid_.top_dim();
  const auto facet = [&](const SeamBridge& b) { return cell(top - 1, b.cell, b.value); };
  const auto top_cell = [&](const SeamRoot& root) { return cell(top, root.cell, root.value); };
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
