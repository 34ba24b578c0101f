// SPDX-License-Identifier: MIT
#include "ph/loops.hpp"
#include "ph/detail/rips/rips_filtration.hpp"

#include "libph/src/loops/tighten.hpp"

namespace ph {
namespace {

/// True if bar i has a chain of edges that can be split into walks.
bool has_walks(const Barcode& cycles, std::size_t i) {
  return cycles[i].dim == 1 && cycles.cell_kind() != CellKind::row &&
         cycles.representative(i).size() > 0;
}

std::vector<BarLoops> plain_loops(const Barcode& cycles, const Options& options,
                                  std::span<const Index> periods, const RunContext& context) {
  if (cycles.size() == 0) return {};
  if (cycles.representatives() != Representatives::cycles &&
      cycles.representatives() != Representatives::voxels)
    throw Error(ErrorKind::usage,
                "loops: found a barcode without cycles, expected one with cycles");
  std::size_t bytes = cycles.size() * sizeof(BarLoops);
  MemoryClaim claim(context.memory, bytes);
  std::vector<BarLoops> loops(cycles.size());
  Ticker ticker(context, "loops", cycles.size());
  for (std::size_t i = 0; i < cycles.size(); ++i, ticker.tick()) {
    if (!has_walks(cycles, i)) continue;
    loops[i].loops = closed_walks(cycles.representative(i), options.field, periods, context);
    bytes += bytes_of(std::span(loops).subspan(i, 1));
    claim.grow_to(bytes);
  }
  return loops;
}

}  // namespace

std::vector<BarLoops> loops(const Rips& rips, const Barcode& cycles, const Options& options,
                            bool tighten, const RunContext& context) {
  std::vector<BarLoops> found = plain_loops(cycles, options, {}, context);
  const MemoryClaim claim(context.memory, bytes_of(found));
  const RunPlan planned = plan(rips, options, context);
  const RipsGraph& graph = rips.graph(*planned.form, context);
  detail::measure_and_tighten(graph, cycles, options, tighten, found, context);
  return found;
}

std::vector<BarLoops> loops(const Cubical& cubical, const Barcode& cycles, const Options& options,
                            bool, const RunContext& context) {
  const CubicalImage image = cubical.cubical_image();
  std::vector<Index> periods;
  for (std::size_t k = 0; k < image.extents.size(); ++k)
    periods.push_back(image.periodic[k] ? 2 * image.extents[k] : 0);
  return plain_loops(cycles, options, periods, context);
}

std::vector<BarLoops> loops(const ExplicitComplex&, const Barcode& cycles, const Options& options,
                            bool, const RunContext& context) {
  return plain_loops(cycles, options, {}, context);
}

std::vector<BarLoops> loops(const Alpha&, const Barcode& cycles, const Options& options, bool,
                            const RunContext& context) {
  return plain_loops(cycles, options, {}, context);
}

std::vector<BarLoops> loops(const AnyComplex& complex, const Barcode& cycles,
                            const Options& options, bool tighten, const RunContext& context) {
  return std::visit([&](const auto& c) { return loops(c, cycles, options, tighten, context); },
                    complex);
}

}  // namespace ph
