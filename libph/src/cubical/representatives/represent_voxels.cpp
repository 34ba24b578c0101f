// SPDX-License-Identifier: MIT
#include "libph/src/cubical/representatives/represent_voxels.hpp"

#include <algorithm>
#include <memory>
#include <type_traits>

#include "libph/src/cubical/loops/dual_loop_reduction.hpp"
#include "libph/src/cubical/loops/loop_reduction.hpp"
#include "libph/src/cubical/representatives/component_tree.hpp"
#include "libph/src/cubical/representatives/forest_closing.hpp"
#include "libph/src/cubical/representatives/nested_sets.hpp"
#include "libph/src/cubical/representatives/represented_pairs.hpp"
#include "libph/src/cubical/representatives/separating_cycles.hpp"
#include "libph/src/cubical/representatives/torus_surfaces.hpp"
#include "libph/src/image/voxels_in_use.hpp"

namespace ph::cubical {
namespace {

/// True if the nodes of the graph are the top cells.
template <class Graph>
constexpr bool kIsDual = std::is_same_v<Graph, TopGraph>;

/// The components of an image with one axis in the V-construction, as sets of voxels. With one
/// axis, the T-construction has the same components.
class LineComponents {
 public:
  LineComponents(const CubicalImage& image, const RunContext& context)
      : grid_(with_vertices(image), context),
        graph_(grid_),
        edges_(critical_cells(grid_, 1, context)),
        tree_(grid_, graph_, edges_, context),
        sets_(
            tree_, Before::value, grid_.size(),
            [&](std::uint32_t v) {
              if (!grid_.enters(v)) return NestedSets::kNone;
              return tree_.holder(tree_.basin_of(v), grid_.value(v), v, Before::value);
            },
            [](std::uint32_t v) { return v; }, context) {}

  const NestedSets& sets() const { return sets_; }
  /// The component that is born with a voxel.
  std::uint32_t born_at(std::uint32_t voxel) { return tree_.basin_of(voxel); }

 private:
  static CubicalImage with_vertices(CubicalImage image) {
    image.voxels_are_vertices = true;
    return image;
  }
  StarGrid grid_;
  VoxelGraph graph_;
  CriticalCells edges_;
  ComponentTree<VoxelGraph> tree_;
  NestedSets sets_;
};

template <Field K>
class Representing {
 public:
  Representing(const CubicalImage& image, const K& field, int max_dim, Representatives kind,
               const RunContext& context, const RepresentativeSink& sink)
      : image_(image),
        field_(field),
        context_(context),
        sink_(sink),
        wants_no_loops_(max_dim == 0),
        grid_(image, context),
        pairs_(grid_, field, kind, context, sink) {}

  void run() {
    if (grid_.top_dim() == 3)
      run_three_axes();
    else
      run_few_axes();
  }

 private:
  using Rep = Representation<K>;
  using Fill = typename RepresentedPairs<K>::Fill;

  void run_few_axes() {
    CriticalCells edges = critical_cells(grid_, 1, context_);
    const int top = grid_.top_dim();
    const bool turned_around = grid_.is_t_construction();
    const VoxelGraph voxels(grid_);
    if (top < 2) {
      // With fewer than two axes, the graph of voxels is the only graph. In the T-construction, it
      // is the dual graph and also gives H0.
      ComponentTree<VoxelGraph> tree(grid_, voxels, edges, context_);
      if (turned_around) return add_line(tree, edges);
      add_components(tree);
      return close_left(tree, edges);
    }
    const TopGraph tops(grid_);
    if (turned_around) {
      ComponentTree<TopGraph> components(grid_, tops, edges, context_);
      add_components(components);
      if (wants_no_loops_) return;
      add_hollows(ComponentTree<VoxelGraph>(grid_, voxels, edges, context_));
      close_left(components, edges);
    } else {
      ComponentTree<VoxelGraph> components(grid_, voxels, edges, context_);
      add_components(components);
      if (wants_no_loops_) return;
      add_hollows(ComponentTree<TopGraph>(grid_, tops, edges, context_));
      close_left(components, edges);
    }
  }

  void run_three_axes() {
    const VoxelGraph voxels(grid_);
    const TopGraph tops(grid_);
    CriticalCells edges(&context_.memory), squares(&context_.memory);
    const bool turned_around = grid_.is_t_construction();
    if (!turned_around || !wants_no_loops_) edges = critical_cells(grid_, 1, context_);
    if (turned_around || !wants_no_loops_) squares = critical_cells(grid_, 2, context_);
    if (turned_around) {
      ComponentTree<TopGraph> components(grid_, tops, squares, context_);
      add_components(components);
      if (wants_no_loops_) return;
      add_hollows(ComponentTree<VoxelGraph>(grid_, voxels, edges, context_));
      add_loops(components, edges, squares);
    } else {
      ComponentTree<VoxelGraph> components(grid_, voxels, edges, context_);
      add_components(components);
      if (wants_no_loops_) return;
      add_hollows(ComponentTree<TopGraph>(grid_, tops, squares, context_));
      mark_paired(grid_, edges);
      add_loops(components, squares);
    }
  }

  // Adds the bar of a merge, with the pair that `pair_vertices_with_edges` or
  // `pair_facets_with_top_cells` finds.
  template <class Graph>
  void add_merge(ComponentTree<Graph>& tree, const ComponentTree<Graph>::Merge& merge,
                 const Fill& fill) {
    const StarCell bridge = tree.bridge_cell(merge.bridge);
    const int top = grid_.top_dim();
    if (tree.is_outer(merge.dies))
      pairs_.essential(kIsDual<Graph> ? top - 1 : 1, bridge, fill);
    else if (kIsDual<Graph>)
      pairs_.pair(top - 1, bridge, tree.root_cell(merge.dies), fill);
    else
      pairs_.pair(0, tree.root_cell(merge.dies), bridge, fill);
  }
  template <class Graph, class FillOf>
  void add_survivors(ComponentTree<Graph>& tree, FillOf&& fill_of) {
    for (std::uint32_t b = 0; b < tree.basin_count(); ++b)
      if (!tree.is_outer(b) && !tree.dies(b))
        pairs_.essential(kIsDual<Graph> ? grid_.top_dim() : 0, tree.root_cell(b), fill_of(b));
  }

  // Adds H0. The nodes of its graph are the vertices of the input. In V, they are the voxels; in T,
  // they are the top cells of the stars' grid.
  template <class Graph>
  void add_components(ComponentTree<Graph>& tree) {
    std::optional<NestedSets> sets;
    std::size_t stored = 0;
    if (pairs_.wants_sets()) stored = make_sets(tree, false, sets);
    Ticker ticker(context_, "bars of components", tree.merges().size());
    for (const auto& merge : tree.merges()) {
      ticker.tick();
      add_merge(tree, merge, [&](Rep& rep) {
        if (rep.as_set) return give_set(*sets, stored, merge.dies, rep);
        rep.chain.emplace_back(tree.root_cell(merge.dies), field_.from_int(1));
        rep.chain.emplace_back(tree.root_cell(merge.into), field_.from_int(-1));
      });
    }
    add_survivors(tree, [&](std::uint32_t b) {
      return [&, b](Rep& rep) {
        if (rep.as_set) return give_set(*sets, stored, b, rep);
        rep.chain.emplace_back(tree.root_cell(b), field_.from_int(1));
      };
    });
  }

  // Adds the second highest and the highest dimension, which the dual graph gives.
  template <class Graph>
  void add_hollows(ComponentTree<Graph>&& tree) {
    std::optional<NestedSets> sets;
    std::size_t stored = 0;
    if (pairs_.wants_hollows()) stored = make_sets(tree, true, sets);
    // If sets are wanted, only a few bars need a separating cycle.
    std::unique_ptr<SeparatingCycles<Graph, K>> cycles;
    const auto separating = [&]() -> SeparatingCycles<Graph, K>& {
      if (!cycles) cycles = std::make_unique<SeparatingCycles<Graph, K>>(tree, field_, context_);
      return *cycles;
    };
    Ticker ticker(context_, "bars of hollows", tree.merges().size());
    for (const auto& merge : tree.merges()) {
      ticker.tick();
      add_merge(tree, merge, [&](Rep& rep) {
        if (rep.as_set) give_set(*sets, stored, merge.dies, rep);
        // An empty set cannot represent a hollow. Such a hollow gets a separating cycle instead.
        if (rep.voxels.begin != rep.voxels.end) return;  // mutant: voxels-of-hollow
        separating().append(merge.dies, rep.chain);
      });
    }
    add_survivors(tree, [&](std::uint32_t b) {
      return [&, b](Rep& rep) { separating().append_all(b, rep.chain); };
    });
  }

  // Stores the sets of voxels of all components, as Before::value defines them. @return the
  // position of the first stored voxel among all voxels stored.
  template <class Graph>
  std::size_t make_sets(ComponentTree<Graph>& tree, bool with_absent,
                        std::optional<NestedSets>& sets) {
    Direction up{};
    for (int a = 0; a < 3; ++a) up[a] = grid_.has_axis(a) ? 1 : 0;
    const auto holder_of = [&](std::uint32_t v) {
      if (!with_absent && !grid_.enters(v)) return NestedSets::kNone;
      // All top cells around a voxel are connected as soon as the voxel enters.
      std::uint32_t node = v;
      if constexpr (kIsDual<Graph>) node = tree.graph().node(v, up);
      return tree.holder(tree.basin_of(node), grid_.value(v), v, Before::value);
    };
    sets.emplace(
        tree, Before::value, grid_.size(), holder_of,
        [&](std::uint32_t v) { return grid_.place(v); }, context_);
    sets->forget_components();
    return sink_.store(sets->items());
  }
  static void give_set(const NestedSets& sets, std::size_t stored, std::uint32_t basin, Rep& rep) {
    const auto [begin, end] = sets.range(basin);
    rep.voxels = {stored + begin, stored + end};
  }

  // Handles T with one axis or none. In this case, the graph of voxels is the dual graph, whose
  // components are the gaps between the components of T. As sets of voxels, the components of T
  // equal the components of V.
  void add_line(ComponentTree<VoxelGraph>& tree, const CriticalCells& edges) {
    SeparatingCycles<VoxelGraph, K> cycles(tree, field_, context_);
    std::optional<LineComponents> line;
    if (pairs_.wants_sets()) line.emplace(image_, context_);
    const std::size_t stored = line ? sink_.store(line->sets().items()) : 0;
    const auto give = [&](const StarCell& birth, Rep& rep) {
      give_set(line->sets(), stored, line->born_at(grid_.place(birth.voxel)), rep);
    };
    for (const auto& merge : tree.merges())
      add_merge(tree, merge, [&](Rep& rep) {
        if (rep.as_set) return give(tree.bridge_cell(merge.bridge), rep);
        cycles.append(merge.dies, rep.chain);
      });
    add_survivors(tree, [&](std::uint32_t b) {
      return [&, b](Rep& rep) {
        if (rep.as_set && grid_.top_dim() == 0) return give(tree.root_cell(b), rep);
        cycles.append_all(b, rep.chain);
      };
    });
    // Adds the class that goes around a periodic axis.
    for (const auto& [value, cell] : edges.order) {
      const StarCell edge{edges.cells[cell].voxel, kEdges[edges.cells[cell].number], value};
      pairs_.essential(1, edge, [&](Rep& rep) {
        if (rep.as_set) return give(edge, rep);
        rep.chain.emplace_back(edge, field_.from_int(1));
      });
    }
  }

  // Adds the classes that go around periodic axes, for at most two axes. The edges that are not
  // paired give birth to these classes.
  template <class Graph>
  void close_left(ComponentTree<Graph>& tree, const CriticalCells& edges) {
    if (edges.order.empty() || wants_no_loops_) return;
    ForestClosing<Graph, K> closing(tree, field_, context_);
    for (const auto& [value, cell] : edges.order) {
      const StarCell edge{edges.cells[cell].voxel, kEdges[edges.cells[cell].number], value};
      pairs_.essential(1, edge, [&](Rep& rep) {
        rep.chain.emplace_back(edge, field_.from_int(1));
        closing.close(rep.chain);
      });
    }
  }

  // Adds H1 of V, and the classes of H2 that never die.
  void add_loops(ComponentTree<VoxelGraph>& tree, const CriticalCells& squares) {
    using Reduction = LoopReduction<K, StarGrid>;
    const FreeEdges free = free_edges(grid_, context_);
    Reduction reduction(grid_, free, squares, field_, context_);
    reduction.reduce_to_cycles();
    const auto cell_of = [&](const typename Reduction::Term& term) {
      const std::uint32_t v = grid_.here(term.cell.voxel());
      return StarCell{v, kEdges[grid_.tables(v).edge_order().at(term.cell.rank())], 0};
    };
    add_classes(tree, reduction, cell_of, 2);
  }
  // Adds H1 of T.
  void add_loops(ComponentTree<TopGraph>& tree, const CriticalCells& edges,
                 const CriticalCells& squares) {
    const DualLoopReduction<K> reduction(grid_, edges, squares, field_, context_);
    const auto cell_of = [&](const typename DualLoopReduction<K>::Term& term) {
      return reduction.cell(term.cell);
    };
    add_classes(tree, reduction, cell_of, 1);
  }
  // Adds the classes that a reduction finds. @param surface the dimension of surfaces in the stars'
  // grid.
  template <class Graph, class Reduction, class CellOf>
  void add_classes(ComponentTree<Graph>& tree, Reduction&& reduction, CellOf&& cell_of,
                   int surface) {
    ForestClosing<Graph, K> closing(tree, field_, context_);
    const TorusSurfaces<K> surfaces(grid_, field_, context_);
    reduction.for_each_class(
        [&](const StarCell& edge, const StarCell& square, const auto& pivot, auto below) {
          pairs_.pair(1, edge, square, [&](Rep& rep) {
            rep.chain.emplace_back(cell_of(pivot), pivot.coefficient());
            for (const auto& term : below)
              rep.chain.emplace_back(cell_of(term), term.coefficient());
            closing.close(rep.chain);
          });
        },
        [&](const StarCell& birth) {
          pairs_.essential(surface, birth, [&](Rep& rep) { surfaces.append(birth, rep.chain); });
        },
        [&](const StarCell& birth) {
          pairs_.essential(3 - surface, birth, [&](Rep& rep) {
            rep.chain.emplace_back(birth, field_.from_int(1));
            closing.close(rep.chain);
          });
        });
  }

  const CubicalImage& image_;
  const K& field_;
  const RunContext& context_;
  const RepresentativeSink& sink_;
  const bool wants_no_loops_;
  StarGrid grid_;
  RepresentedPairs<K> pairs_;
};

}  // namespace

bool can_represent_voxels(const CubicalImage& grid) { return StarGrid::can_hold(grid); }

template <Field K>
void represent_voxels(const CubicalImage& grid, const K& field, int max_dim, Representatives kind,
                      const RunContext& context, const RepresentativeSink& sink) {
  const VoxelsInUse voxels_are_read(grid, context);
  Representing<K>(grid, field, max_dim, kind, context, sink).run();
}

template void represent_voxels(const CubicalImage&, const Z2&, int, Representatives,
                               const RunContext&, const RepresentativeSink&);
template void represent_voxels(const CubicalImage&, const Zp&, int, Representatives,
                               const RunContext&, const RepresentativeSink&);

}  // namespace ph::cubical
