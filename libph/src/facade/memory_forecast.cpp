// SPDX-License-Identifier: MIT
#include "libph/src/facade/memory_forecast.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "libph/src/rips/clique_count.hpp"

#include "ph/detail/rips/rips_graph.hpp"

namespace ph::detail {
namespace {

// The first constant is the number of bytes per bar while bars are sorted. The second constant is
// the additional number of bytes per bar for its birth and death cells (vertex and edge, or edge
// and triangle).
constexpr double kBytesPerBar = 24 + 24, kBytesPerCells = 32 + 5 * 8 + 48;
double bytes_per_bar(const Options& options) {
  return kBytesPerBar + (options.cells ? kBytesPerCells : 0);
}

// The number of bytes that every run needs for small containers, the allocator, and the pages of
// the program's own code.
constexpr double kAlways = 4 << 20;
// A forecast runs the engine on parts of the complex. These constants determine how many cells the
// engine lists in the largest part. The number is large enough to show how memory grows, but small
// enough to take only seconds and a fraction of the total time.
constexpr double kPilotEdges = 40'000, kPilotCells = 60'000, kPilotShare = 0.125;
constexpr double kMostPilotEdges = 4e6, kMostPilotCells = 250'000;
// These constants are safety margins. Measurements show that memory grows in leaps. It also grows
// faster from a part to the entire complex than from a small part to a larger one, unless the
// complex consists of many similar parts side by side.
constexpr double kMargin = 3, kPowerMargin = 0.35, kPowerMarginOfLocal = 0.1;

double sum(std::span<const double> counts) {
  return std::accumulate(counts.begin(), counts.end(), 0.0);
}

/// The memory for bit rows or adjacency lists. It does not depend on the homology, and does not
/// include the edges.
double structure(std::size_t size, std::size_t edge_count, Engine engine) {
  if (const auto bytes_of_engine = facts_of(engine).rips_bytes)
    return bytes_of_engine(size, edge_count);
  const auto vertices = static_cast<double>(size);
  return RipsAdjacency::is_dense(size, edge_count)
             ? 4 * vertices * vertices
             : 16 * static_cast<double>(edge_count) + 8 * vertices;
}
double structure(const RipsGraph& graph, Engine engine) {
  return structure(static_cast<std::size_t>(graph.size()), graph.edge_count(), engine);
}

/// A part of a complex, which consists of the chosen vertices and all edges between them.
RipsGraph induced(const RipsGraph& graph, std::span<const std::uint32_t> vertices,
                  const RunContext& context) {
  constexpr std::uint32_t none = UINT32_MAX;
  std::pmr::vector<std::uint32_t> number(static_cast<std::size_t>(graph.size()), none,
                                         &context.memory);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    number[vertices[i]] = static_cast<std::uint32_t>(i);
  std::pmr::vector<WeightedEdge> edges(&context.memory);
  const BinnedEdges& all = graph.binned_edges();
  all.with_bins(0, all.bin_count(), [&](std::span<const FlagEdge> unsorted) {
    for (const FlagEdge& e : unsorted) {
      const std::uint32_t u = number[e.u], v = number[e.v];
      if (u != none && v != none) edges.push_back({Index{u}, Index{v}, e.value});
    }
  });
  std::vector<double> births;
  if (!graph.births().empty())
    for (const std::uint32_t v : vertices) births.push_back(graph.birth(v));
  // The values of the edges already account for the births.
  const VertexWeights weights(births, WeightExponent::infinity);
  return RipsGraph::of_edges(static_cast<Index>(vertices.size()), edges, std::nullopt, context,
                             weights);
}

/// The results of running the engine on a part of a complex. They are the number of cells that the
/// engine listed, and the bytes that it used in addition to the edges, `structure` and the bars of
/// H0.
struct Pilot {
  double listed = 0, extra = 0;
};
Pilot run_pilot(const RipsGraph& part, double listed, const Options& options,
                const RunContext& context) {
  RunContext own;
  own.stop = context.stop;
  own.on_progress = context.on_progress;
  own.threads = 1;
  own.memory.set_limit(context.memory.limit() -
                       std::min(context.memory.used(), context.memory.limit()));
  RipsGraph copy = RipsGraph::with_edges(
      part, FlagEdges(part.edges().begin(), part.edges().end(), &own.memory), own);
  const double known =
      16 * static_cast<double>(copy.edge_count()) + structure(copy, options.engine);
  const Barcode barcode = persistence(Rips(std::move(copy)), options, own);
  double bars = 0;
  for (std::size_t i = 0; i < barcode.size(); ++i) bars += barcode[i].dim > 0 ? 1 : 0;
  return {listed, std::max(0.0, static_cast<double>(own.memory.peak()) - known) +
                      bytes_per_bar(options) * bars};
}

double listed_of(const RipsGraph& part, const Options& options, const RunContext& context) {
  return sum(
      count_cliques(part, listed_rips_dim(options.engine, *options.max_dim), context).counts);
}

/// Orders the vertices so that the first k vertices, for any k, span a part that is similar to the
/// entire graph. The order is random if the graph is dense, that is, if about a quarter of the
/// pairs of vertices or more are edges. Otherwise it is breadth first, starting from a random
/// vertex of each component.
std::vector<std::uint32_t> order_of(const RipsGraph& graph, std::uint64_t seed) {
  std::vector<std::uint32_t> order(static_cast<std::size_t>(graph.size()));
  std::iota(order.begin(), order.end(), 0U);
  std::mt19937_64 random(seed);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  if (graph.is_dense()) return order;
  const RipsAdjacency& adjacency = graph.adjacency();
  std::vector<std::uint32_t> ball;
  std::vector<bool> is_in(order.size(), false);
  std::size_t next = 0;
  for (const std::uint32_t start : order) {
    if (is_in[start]) continue;
    is_in[start] = true;
    ball.push_back(start);
    for (; next < ball.size(); ++next)
      for (const auto& neighbour : adjacency.neighbours(ball[next])) {
        if (is_in[neighbour.vertex]) continue;
        is_in[neighbour.vertex] = true;
        ball.push_back(neighbour.vertex);
      }
  }
  return ball;
}

/// The number of vertices at the beginning of `order` that span a part in which the engine lists
/// about `wanted` cells. @param listed the number of cells that the engine lists in the entire
/// complex.
std::size_t pilot_size(const RipsGraph& graph, std::span<const std::uint32_t> order, double listed,
                       double wanted, const Options& options, const RunContext& context) {
  std::size_t size = order.size();
  const int vertices_of_cell = 1 + listed_rips_dim(options.engine, *options.max_dim);
  while (size > 8 && listed > 1.25 * wanted) {
    const double step = std::pow(wanted / listed, 1.0 / vertices_of_cell);
    size = std::max<std::size_t>(
        8, static_cast<std::size_t>(static_cast<double>(size) * std::clamp(step, 0.1, 0.9)));
    const RipsGraph part = induced(graph, order.first(size), context);
    listed = listed_of(part, options, context);
  }
  return size;
}

}  // namespace

int listed_rips_dim(Engine engine, int max_dim) {
  return std::max(0, facts_of(engine).listed_dim(max_dim));
}

MemoryForecast forecast_rips(const RipsGraph& graph, std::span<const double> cells,
                             const Options& options, const RunContext& context) {
  const double listed = sum(cells);
  const double edges = 16 * static_cast<double>(graph.edge_count());
  const double known = edges + structure(graph, options.engine);
  const double most = known + bytes_per_bar(options) * static_cast<double>(graph.size()) + kAlways;
  // The sweep of edge links stops once nothing more can happen, usually before its lists are full.
  const double least = options.engine == Engine::edge_links ? edges : known;
  if (graph.is_forest() || graph.size() < 2) return {least, most};
  const bool lists_edges_only = listed_rips_dim(options.engine, *options.max_dim) < 2;
  const double wanted = lists_edges_only
                            ? std::clamp(kPilotShare * listed, kPilotEdges, kMostPilotEdges)
                            : std::clamp(kPilotShare * listed, kPilotCells, kMostPilotCells);
  const auto pilot = [&](std::uint64_t seed, double cells_wanted) {
    const auto order = order_of(graph, seed);
    const std::size_t size = pilot_size(graph, order, listed, cells_wanted, options, context);
    const RipsGraph part = induced(graph, std::span(order).first(size), context);
    return run_pilot(part, listed_of(part, options, context), options, context);
  };
  const Pilot large = pilot(1, wanted);
  if (large.listed >= listed) return {least, most + 1.25 * large.extra};
  // The extra memory is assumed to be proportional to listed^power. The power is fitted to the
  // large part and to the mean of two smaller parts. A mean is used because memory grows in leaps.
  Pilot small;
  for (const std::uint64_t seed : {1, 2}) {
    const Pilot one = pilot(seed, wanted / 4);
    small.listed += one.listed / 2;
    small.extra += one.extra / 2;
  }
  double power = 1;
  if (small.extra > 0 && large.listed > small.listed && small.listed > 0)
    power = std::log(large.extra / small.extra) / std::log(large.listed / small.listed);
  power = std::clamp(power, 0.8, 1.6) + (graph.is_dense() ? kPowerMargin : kPowerMarginOfLocal);
  const double factor = listed / std::max(1.0, large.listed);
  return {least, most + kMargin * large.extra * std::pow(factor, power)};  // mutant: estimate-parts
}

MemoryForecast forecast_edges(Index vertices, double edges, const Options& options) {
  // The sample gives the approximate number of edges, but does not show how much memory the engine
  // needs for them.
  constexpr double fewer = 0.9, margin = 3;
  const double held = 16 * edges;
  const double known = held + structure(static_cast<std::size_t>(vertices),
                                        static_cast<std::size_t>(edges), options.engine);
  return {fewer * held,
          margin * known + bytes_per_bar(options) * static_cast<double>(vertices) + kAlways};
}

MemoryForecast forecast_points(PointsView points, std::optional<double> threshold,
                               const Options& options, const RunContext& context) {
  const double held = 8 * static_cast<double>(points.size());
  constexpr Index kLarge = 8'000, kSmall = 2'000;
  std::mt19937_64 random(1);
  const auto peak_of = [&](Index count) {
    Points sample(count, points.cols());
    for (Index i = 0; i < count; ++i) {
      const auto from = static_cast<Index>(
          random() % static_cast<std::uint64_t>(std::max<Index>(1, points.rows())));
      for (Index k = 0; k < points.cols(); ++k) sample(i, k) = points(from, k);
    }
    RunContext own;
    own.stop = context.stop;
    own.on_progress = context.on_progress;
    own.threads = 1;
    own.memory.set_limit(context.memory.left());
    const RipsOptions rips_options{.threshold = threshold, .merge_equal_points = false};
    const Barcode barcode = persistence(Rips(std::move(sample), rips_options, own), options, own);
    return static_cast<double>(own.memory.peak());
  };
  const double least = 2.5 * held;  // the tree holds a copy of the points, and boxes
  if (points.rows() == 0) return {held, held + kAlways};
  const Index large = std::min(kLarge, points.rows()), small = std::min(kSmall, points.rows());
  const double of_large = peak_of(large);
  const double of_small = peak_of(small);
  double power = 1;
  if (small < large)
    power = std::log(of_large / of_small) /
            std::log(static_cast<double>(large) / static_cast<double>(small));
  // Measurements show that memory is needed not only for the data per point, but also for pairs of
  // nodes on opposite sides of holes, which wait in the queue. The power is therefore raised.
  power = std::clamp(power, 1.0, 1.6) + kPowerMarginOfLocal;
  const double factor = static_cast<double>(points.rows()) / static_cast<double>(large);
  return {least, held + 2 * of_large * std::pow(factor, power) +
                     bytes_per_bar(options) * 1.5 * static_cast<double>(points.rows()) + kAlways};
}

MemoryForecast forecast_voxels(double stored, double voxels, double cells,
                               bool with_representatives) {
  // These byte counts were measured on noise. They cover critical cells with their columns, and
  // bars. Representatives need more memory, because their chains are long.
  const double bytes_per_cell = with_representatives ? 90 : 20;
  constexpr double least_cells_per_voxel = 8;
  return {stored,
          stored + bytes_per_cell * std::max(least_cells_per_voxel * voxels, cells) + kAlways};
}

MemoryForecast forecast_intervals(double stored, bool with_representatives) {
  // These factors are measured multiples of the stored bytes. They allow for critical simplices
  // with their columns (almost none for a surface, many for noise) and, with representatives, for
  // cycles.
  return {stored, (with_representatives ? 5.5 : 2.0) * stored + kAlways};
}

MemoryForecast forecast_cells(double stored, std::span<const double> cells) {
  // The bytes per cell, either for its column with entries in the table of pivots and in the list
  // of columns to reduce, or for its pair. Fill-in is not counted.
  constexpr double bytes_per_column = 128;
  return {stored, stored + bytes_per_column * sum(cells) + kAlways};
}

}  // namespace ph::detail
