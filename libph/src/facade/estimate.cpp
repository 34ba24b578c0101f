// SPDX-License-Identifier: MIT
#include "ph/estimate.hpp"

#include <algorithm>
#include <new>
#include <optional>

#include "libph/src/facade/memory_forecast.hpp"
#include "libph/src/facade/rips_plan.hpp"
#include "libph/src/rips/clique_count.hpp"
#include "ph/detail/complex/cubical_cells.hpp"
#include "ph/detail/core/machine_memory.hpp"
#include "ph/detail/cubical/pair_voxels.hpp"
#include "ph/detail/rips/edge_collapse.hpp"

namespace ph {
namespace {

// The largest number of edges that an estimate collapses. With more edges, the collapse takes more
// than about a second.
constexpr std::size_t kFewEdges = 300'000;

template <Filtration F>
std::vector<double> cells_of(const F& filtration, int top, const RunContext& context) {
  std::vector<double> cells;
  if (top >= 0) prepare_cells(filtration, context);
  for (int d = 0; d <= std::min(top, filtration.top_dim()); ++d) {
    double count = 0;
    filtration.for_each_cell(d, [&](const auto&) { ++count; });
    cells.push_back(count);
  }
  return cells;
}

/// The number of bytes that the complex occupies while the engine runs.
double stored_bytes(const Cubical& cubical, bool lists_cells) {
  const auto voxels = static_cast<double>(cubical.cubical_image().size());
  const auto held = static_cast<double>(cubical.voxel_bytes());
  if (cubical.slot_count() == 0 || !lists_cells) return held;
  return held + 4 * static_cast<double>(cubical.slot_count()) + 8 * voxels;
}
double stored_bytes(const ExplicitComplex& complex, bool) {
  double entries = 0;
  for (int d = 1; d <= complex.top_dim(); ++d) {
    complex.for_each_cell(d, [&](const auto& c) {
      complex.for_each_facet(d, c, [&](const auto&, int) { ++entries; });
    });
  }
  return 44 * static_cast<double>(complex.size()) + 16 * entries;
}

double stored_bytes(const Alpha& alpha, bool lists_cells) {
  // Bytes per top cell of the triangulation, and bytes per cell if cells are listed for generic
  // engines.
  constexpr double bytes_of_top_cell = 90, bytes_of_listed_cell = 160;
  const std::vector<std::size_t> counts = alpha.simplex_counts();
  double all = 0;
  for (const std::size_t count : counts) all += static_cast<double>(count);
  const double held = counts.empty() ? 0 : bytes_of_top_cell * static_cast<double>(counts.back());
  return held + (lists_cells ? bytes_of_listed_cell * all : 0);
}

detail::MemoryForecast forecast_voxels(const Cubical& cubical, double held,
                                       const cubical::BarRequest& wanted, bool with_representatives,
                                       const RunContext& context) {
  if (cubical.slot_count() == 0) return detail::forecast_voxels(held, 0, 0, with_representatives);
  const CubicalImage grid = cubical.cubical_image();
  detail::MemoryForecast forecast = detail::forecast_voxels(
      held + cubical::bytes_to_pair_voxels(grid), static_cast<double>(grid.size()),
      static_cast<double>(cubical.slot_count()), with_representatives);
  const double left = static_cast<double>(context.memory.left());
  const bool is_short = forecast.high - held > left || context.slab_layers > 0;
  if (!is_short || with_representatives) return forecast;
  forecast.low = held + cubical::least_bytes_to_pair_voxels(grid);
  constexpr double bytes_of_bars = 8;  // measured on noise, per voxel
  if (cubical::can_pair_by_layers(grid, wanted))
    forecast.high = std::max(std::min(forecast.high, held + left),
                             forecast.low + bytes_of_bars * static_cast<double>(grid.size()));
  return forecast;
}

template <class Complex>
Estimate estimate_one(const Complex& complex, const Options& options, const RunContext& context) {
  Estimate e;
  static_cast<RunPlan&>(e) = plan(complex, options, context);
  const int max_dim = *e.options.max_dim;
  const int listed_dim = facts_of(e.options.engine).listed_dim(max_dim);
  e.bytes_held = stored_bytes(complex, listed_dim >= 0);
  e.cells = cells_of(complex, listed_dim, context);
  detail::MemoryForecast forecast = detail::forecast_cells(e.bytes_held, e.cells);
  if constexpr (std::same_as<Complex, Cubical>)
    if (listed_dim < 0)
      forecast = forecast_voxels(complex, e.bytes_held, {options.min_dim, max_dim},
                                 options.representatives != Representatives::none, context);
  if constexpr (std::same_as<Complex, Alpha>)
    if (listed_dim < 0)
      forecast = detail::forecast_intervals(e.bytes_held,
                                            options.representatives != Representatives::none);
  e.counted_dims = static_cast<int>(e.cells.size());
  const auto [low, high] = forecast;
  e.bytes_low = low;
  e.bytes_high = high;
  return e;
}

/// Makes the planned form of a filtration, if it does not exist yet, and computes the estimate from
/// it.
Estimate estimate_built(const Rips& rips, const RunPlan& planned, const RunContext& context) {
  Estimate e;
  static_cast<RunPlan&>(e) = planned;
  const RipsGraph& graph = rips.graph(*planned.form, context);
  e.built = facts(rips, planned, context);
  Options settled = planned.options;
  settled.collapse = Collapse::off;
  if (const PointsView* points = graph.points_alone()) {
    e.bytes_held = 8 * static_cast<double>(points->size());
    const auto [low, high] =
        detail::forecast_points(*points, rips.options().threshold, settled, context);
    e.bytes_low = low;
    e.bytes_high = high;
    return e;
  }
  const double edges = e.bytes_held = 16 * static_cast<double>(graph.edge_count());
  double collapse = 0;
  std::optional<RipsGraph> collapsed;
  if (planned.options.collapse == Collapse::on) {
    collapse = collapse_bytes(graph) + edges;
    if (graph.edge_count() <= kFewEdges) {
      collapsed = collapse_edges(graph, context);
      collapse += 64 * static_cast<double>(collapsed->edge_count());
    } else {
      e.cells_at_most = true;
    }
  }
  const RipsGraph& complex = collapsed ? *collapsed : graph;
  int& max_dim = *settled.max_dim;
  const CliqueCounts cliques =
      count_cliques(complex, detail::listed_rips_dim(settled.engine, max_dim), context);
  e.cells = cliques.counts;
  e.counted_dims = std::min(cliques.counted_dims, static_cast<int>(e.cells.size()));
  if (collapsed)  // there is no homology in dimensions without cells
    max_dim = std::min(max_dim, std::max(0, static_cast<int>(e.cells.size()) - 1));
  e.options.max_dim = max_dim;
  const auto [low, high] = detail::forecast_rips(complex, e.cells, settled, context);
  // The edges before a collapse are kept until the end.
  const double before = collapsed ? edges : 0;
  e.bytes_low = e.cells_at_most ? collapse : std::max(collapse, low + before);
  e.bytes_high = std::max(collapse, before + high);
  return e;
}

/// The estimate for a filtration whose edges do not fit into memory. The number of edges is
/// estimated from a sample of pairs.
Estimate estimate_sampled(const Rips& rips, const Options& options, const RunContext& context) {
  Estimate e;
  static_cast<RunPlan&>(e) = detail::plan_without_edges(rips, options);
  const RipsSample sample = rips.sample(context);
  e.cells = {static_cast<double>(sample.vertices), sample.edges};
  e.counted_dims = 1;
  const auto [low, high] = detail::forecast_edges(sample.vertices, sample.edges, e.options);
  e.bytes_low = low;
  e.bytes_high = high;
  return e;
}

/// False if making the edges would take a long time and a sample indicates that they would not fit
/// into memory.
bool can_be_tried(const Rips& rips, const RunContext& context) {
  constexpr double bytes_of_edge = 16;
  constexpr Index few_points = 60'000;  // computing their distances takes seconds
  return rips.size() <= few_points || !rips.has_input() || rips.options().approximation ||
         bytes_of_edge * rips.sample(context).edges < static_cast<double>(context.memory.left());
}

Estimate estimate_one(const Rips& rips, const Options& options, const RunContext& context) {
  // An estimate must not fill the memory of the machine. That memory is therefore the limit, unless
  // the limit of the context leaves less.
  RunContext within(context.memory);
  within.memory.set_limit(std::min(context.memory.left(), machine_memory()));
  within.stop = context.stop;
  within.on_progress = context.on_progress;
  within.threads = context.threads;
  try {
    if (detail::form_without_edges(rips, options) || can_be_tried(rips, within))
      return estimate_built(rips, detail::plan_rips(rips, options, within), within);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::resource || !rips.has_input()) throw;
  } catch (const std::bad_alloc&) {
    if (!rips.has_input()) throw;
  }
  return estimate_sampled(rips, options, within);
}

}  // namespace

Estimate estimate(const AnyComplex& complex, const Options& options, const RunContext& context) {
  return std::visit([&](const auto& c) { return estimate_one(c, options, context); }, complex);
}

}  // namespace ph
