// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

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
std::vector<double> cells_of(const Rips& rips, int top) {
  const double n = static_cast<double>(rips.size());
  std::vector<double> cells{n};
  if (top >= 1) cells.push_back(static_cast<double>(rips.edge_count()));
  if (top < 2) return cells;
  const double degeneracy = static_cast<double>(rips.graph().adjacency().clique_bound()) - 1;
  for (int d = 2; d <= top; ++d)
    cells.push_back(std::min(binomial(n, d + 1), n * binomial(degeneracy, d)));
  return cells;
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
  if (engine == Engine::lens) return 16 * e + n * n / 4;
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

template <class Complex>
Estimate estimate_of(const Complex& complex, Engine asked, const detail::Plan& plan) {
  const auto& [max_dim, choice] = plan;
  Estimate e;
  e.engine = choice.engine;
  e.reason = asked == Engine::automatic ? std::string(choice.reason) : "asked for";
  e.max_dim = max_dim;
  e.cells = cells_of(complex, goes_by_edges(e.engine) ? 1 : max_dim + 1);
  e.bytes_low = stored_bytes(complex, e.engine);
  double columns = 0;
  const auto count = [&](int first, int last) {
    for (int d = std::max(first, 0); d <= last && d < static_cast<int>(e.cells.size()); ++d)
      columns += e.cells[static_cast<std::size_t>(d)];
  };
  switch (e.engine) {
    case Engine::union_find:
      count(0, 1);
      break;
    case Engine::cohomology:
      count(0, max_dim);
      break;
    default:
      count(0, max_dim + 1);
      break;
  }
  e.bytes_high = e.bytes_low + kBytesPerColumn * columns;
  return e;
}

}  // namespace

Estimate estimate(const AnyComplex& complex, const Options& options) {
  return std::visit(
      [&](const auto& c) {
        using C = std::remove_cvref_t<decltype(c)>;
        if constexpr (std::same_as<C, Rips>) {
          Options rips_options = options;
          rips_options.max_dim = detail::checked_max_dim(options.max_dim.value_or(1));
          return c.with_filtration(*rips_options.max_dim, [&](const auto& f) {
            return estimate_of(c, options.engine, detail::plan(f, rips_options));
          });
        } else {
          return estimate_of(c, options.engine, detail::plan(c, options));
        }
      },
      complex);
}

}  // namespace ph
