// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "ph/complex/edge_collapse.hpp"
#include "ph/engine/lens_graph.hpp"
#include "ph/persistence.hpp"

namespace ph {
namespace {

double binomial(double n, int k) {
  double result = 1;
  for (int i = 0; i < k; ++i) result *= std::max(0.0, n - i) / (i + 1);
  return result;
}

// Cliques of d + 1 vertices: all sets of vertices at most, and in a graph of degeneracy g each has
// a first vertex in the degeneracy order with at most g later neighbours.
std::vector<double> cells_of(const Rips& rips, int top, double degeneracy) {
  const double n = static_cast<double>(rips.size());
  std::vector<double> cells{n};
  if (top >= 1) cells.push_back(static_cast<double>(rips.edge_count()));
  for (int d = 2; d <= top; ++d)
    cells.push_back(std::min(binomial(n, d + 1), n * binomial(degeneracy, d)));
  return cells;
}
std::vector<double> cells_of(const Rips& rips, int top) {
  // The adjacency takes time and memory to make: only where it is needed anyhow.
  const Index cliques = top < 2 ? 1 : rips.graph().adjacency().clique_bound();
  return cells_of(rips, top, static_cast<double>(cliques - 1));
}

// The largest g such that g vertices have degree g or more: the degeneracy of a graph is no larger,
// and neither is that of any part of it.
Index degeneracy_by_degrees(const Rips& rips) {
  std::vector<Index> degrees(static_cast<std::size_t>(rips.size()), 0);
  for (const FlagEdge& e : rips.graph().edges()) {
    ++degrees[e.u];
    ++degrees[e.v];
  }
  std::ranges::sort(degrees, std::greater{});
  Index g = 0;
  while (g < rips.size() && degrees[static_cast<std::size_t>(g)] > g) ++g;
  return g;
}

template <Filtration F>
std::vector<double> cells_of(const F& filtration, int top) {
  std::vector<double> cells;
  for (int d = 0; d <= std::min(top, filtration.top_dim()); ++d) {
    double count = 0;
    filtration.for_each_cell(d, [&](const auto&) { ++count; });
    cells.push_back(count);
  }
  return cells;
}

// Whether an engine looks at vertices and edges only.
bool goes_by_edges(Engine engine) { return engine == Engine::lens || engine == Engine::union_find; }

double stored_bytes(const Rips& rips, Engine engine) {
  const double n = static_cast<double>(rips.size()), e = static_cast<double>(rips.edge_count());
  if (engine == Engine::lens)
    return 16 * e + LensGraph::bytes(static_cast<std::size_t>(rips.size()), rips.edge_count());
  if (engine == Engine::union_find) return 16 * e;
  return 16 * e + (rips.graph().is_dense() ? 4 * n * n : 16 * e + 8 * n);
}
double stored_bytes(const Cubical& cubical, Engine) {
  double voxels = 0;
  cubical.for_each_cell(0, [&](const auto&) { ++voxels; });
  return 4 * static_cast<double>(cubical.slot_count()) + 8 * voxels;
}
double stored_bytes(const ExplicitComplex& complex, Engine) {
  double entries = 0;
  for (int d = 1; d <= complex.top_dim(); ++d) {
    complex.for_each_cell(d, [&](const auto& c) {
      complex.for_each_facet(d, c, [&](const auto&, int) { ++entries; });
    });
  }
  return 44 * static_cast<double>(complex.size()) + 16 * entries;
}

// Bytes an engine keeps for each cell it turns into a column: the column, its place in the table of
// pivots and in the list to reduce. Fill-in comes on top and cannot be foreseen; as a rule columns
// that are added to are few.
constexpr double kBytesPerColumn = 128;

// Sets bytes_high from bytes_low and the cells.
void add_columns(Estimate& e) {
  const int max_dim = e.max_dim;
  double columns = 0;
  const auto count = [&](int first, int last) {
    for (int d = std::max(first, 0); d <= last && d < static_cast<int>(e.cells.size()); ++d)
      columns += e.cells[static_cast<std::size_t>(d)];
  };
  switch (e.engine) {
    case Engine::union_find:
      count(0, 1);
      break;
    case Engine::lens:  // H2: triangles with a value, of which there are as a rule fewer
      for (int d = 1; d <= std::max(1, max_dim); ++d) count(0, 1);
      break;
    case Engine::cohomology:
      count(0, max_dim);
      break;
    default:
      count(0, max_dim + 1);
      break;
  }
  e.bytes_high = e.bytes_low + kBytesPerColumn * columns;
}

template <class Complex>
Estimate estimate_of(const Complex& complex, const detail::Plan& plan) {
  Estimate e;
  e.engine = plan.choice.engine;
  e.reason = plan.choice.reason;
  e.max_dim = plan.max_dim;
  e.cells = cells_of(complex, goes_by_edges(e.engine) ? 1 : e.max_dim + 1);
  e.bytes_low = stored_bytes(complex, e.engine);
  add_columns(e);
  return e;
}

// How few edges a collapse will leave is not known beforehand: the bounds are those of all edges.
Estimate estimate_of_collapsed(const Rips& rips, int max_dim, const detail::EngineChoice& choice) {
  Estimate e;
  e.engine = choice.engine;
  e.reason = choice.reason;
  const Index degeneracy = degeneracy_by_degrees(rips);
  e.max_dim = static_cast<int>(std::min(Index{max_dim}, degeneracy));
  e.cells =
      cells_of(rips, goes_by_edges(e.engine) ? 1 : e.max_dim + 1, static_cast<double>(degeneracy));
  e.bytes_low = 16 * static_cast<double>(rips.edge_count()) + collapse_bytes(rips.graph());
  add_columns(e);
  e.bytes_high += stored_bytes(rips, e.engine);
  return e;
}

Estimate estimate_of_rips(const Rips& rips, const Options& options, const RunContext& context) {
  Options rips_options = options;
  rips_options.max_dim = detail::rips_max_dim(rips, options);
  const detail::CollapseChoice choice = detail::choose_collapse(rips, rips_options, context);
  Estimate e = choice.collapses ? estimate_of_collapsed(rips, *rips_options.max_dim, choice.engine)
                                : rips.with_filtration(*rips_options.max_dim, [&](const auto& f) {
                                    return estimate_of(rips, detail::plan(f, rips_options));
                                  });
  if (rips.has_only_components()) e.reason += "; a spanning forest knows them";
  e.collapses = choice.collapses;
  e.collapse_reason = choice.reason;
  return e;
}

}  // namespace

Estimate estimate(const AnyComplex& complex, const Options& options, const RunContext& context) {
  return std::visit(
      [&](const auto& c) {
        if constexpr (std::same_as<std::remove_cvref_t<decltype(c)>, Rips>)
          return estimate_of_rips(c, options, context);
        else
          return estimate_of(c, detail::plan(c, options));
      },
      complex);
}

}  // namespace ph
