// SPDX-License-Identifier: MIT
#include "libph/src/cubical/slabs/pair_in_slabs.hpp"

#include <cstdint>
#include <new>
#include <optional>
#include <string>

#include "libph/src/cubical/graphs/two_graphs.hpp"
#include "libph/src/cubical/layers/layer_grid.hpp"
#include "libph/src/cubical/slabs/layer_pairs.hpp"
#include "libph/src/cubical/slabs/slab_loops.hpp"
#include "ph/error.hpp"

namespace ph::cubical {
namespace {

[[noreturn]] void refuse_loops(const GridShape& shape) {
  throw Error(ErrorKind::resource,
              std::string("bars of dimension 1: their critical cells exceed the memory "
                          "limit; ") +
                  (wants_loops(shape, {.min_dim = 2, .max_dim = 2})
                       ? "bars of dimension 0 need less memory (max_dim 0)"
                       : "all other dimensions need less memory (max_dim 0, or min_dim 2)"));
}

/// Runs a task that stores the critical cells of loops. If memory runs out, the error message
/// states that other dimensions need less memory.
template <class Run>
void with_loops(const GridShape& shape, Run&& run) {
  try {
    run();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::resource) throw;
    refuse_loops(shape);
  } catch (const std::bad_alloc&) {
    refuse_loops(shape);
  }
}

}  // namespace

template <Field K>
void pair_in_slabs(Slabs& slabs, const K& field, const BarRequest& wanted,
                   const RunContext& context, PairSink& pairs) {
  const GridShape& shape = slabs.image().shape();
  std::optional<SlabLoops> loops;
  if (wants_loops(shape, wanted)) loops.emplace(GridFrame(slabs.image().all()), context);
  LayerPairs found(shape,
                   {.vertices = loops || wants_vertices(shape, wanted),
                    .tops = loops || wants_top_cells(shape, wanted)},
                   context);
  // Loops are abandoned if they need more than half of the remaining memory. This keeps enough
  // memory for the slabs and the other bars. The columns of loops would need more memory than the
  // slabs.
  const std::size_t reserve = context.memory.left() / 2;
  bool too_many_loops = false;

  const auto add_slab = [&](std::uint64_t slab) {
    const std::uint64_t first = slabs.first_voxel(slab);
    if (shape.top_dim() > 3) {
      found.add(slabs.grid<LayerGrid>(slab), first, pairs);
    } else {
      const StarGrid grid = slabs.stars(slab);
      found.add(grid, first, pairs, loops ? &*loops : nullptr);
      if (loops) loops->add_stars(grid, static_cast<std::uint32_t>(first));
    }
    slabs.forget(slab);
  };
  for (std::uint64_t slab = 0; slab < slabs.count(); ++slab) {
    context.report({"slabs", slab, slabs.count()});
    if (loops)
      with_loops(shape, [&] { add_slab(slab); });
    else
      add_slab(slab);
    if (loops && context.memory.left() < reserve) {
      loops.reset();
      too_many_loops = true;
    }
  }
  found.finish(pairs);
  if (loops) with_loops(shape, [&] { loops->pair(field, pairs); });
  pairs.finish();
  if (too_many_loops) refuse_loops(shape);
}

template void pair_in_slabs(Slabs&, const Z2&, const BarRequest&, const RunContext&, PairSink&);
template void pair_in_slabs(Slabs&, const Zp&, const BarRequest&, const RunContext&, PairSink&);

}  // namespace ph::cubical
