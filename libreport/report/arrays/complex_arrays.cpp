// SPDX-License-Identifier: MIT
#include "libreport/report/arrays/complex_arrays.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "ph/detail/rips/rips_graph.hpp"

namespace ph::report {
namespace {

// The largest numbers of edges and of triangles that a page can draw.
constexpr std::size_t kMostEdges = 40'000, kMostTriangles = 2'000'000;  // mutant: report-triangles

struct ValuedCell {
  double value;
  std::uint32_t id;
  friend auto operator<=>(const ValuedCell&, const ValuedCell&) = default;
};

/// The number that a point has in the input. @param ids the input numbers of the remaining points;
/// empty if all points remain.
std::uint32_t number_of(Index point, std::span<const Index> ids) {
  return static_cast<std::uint32_t>(ids.empty() ? point : ids[static_cast<std::size_t>(point)]);
}

/// Adds the first cells of one dimension, in the order of their values, of a complex that lists its
/// cells.
/// @return the least value of a cell that was left out; empty if all cells were added.
template <class Listed>
std::optional<double> add_first(const Listed& complex, int dim, std::size_t most,
                                std::span<const Index> ids, const RunContext& context,
                                std::vector<std::uint32_t>& numbers, std::vector<float>& values) {
  std::size_t count = 0;
  complex.for_each_cell(dim, [&](ExplicitComplex::Cell) { ++count; });
  const MemoryClaim claim(context.memory, count * sizeof(ValuedCell));
  std::vector<ValuedCell> cells;
  cells.reserve(count);
  complex.for_each_cell(dim, [&](ExplicitComplex::Cell cell) {
    cells.push_back({complex.value(cell), cell.id});
  });
  std::ranges::sort(cells);
  std::optional<double> missing_from;
  if (cells.size() > most) {
    missing_from = cells[most].value;
    cells.resize(most);
  }
  const auto arity = static_cast<std::size_t>(dim) + 1;
  const MemoryClaim kept(context.memory,
                         cells.size() * (arity * sizeof(std::uint32_t) + sizeof(float)));
  numbers.reserve(cells.size() * arity);
  values.reserve(cells.size());
  std::vector<Index> vertices;
  for (const ValuedCell& cell : cells) {
    vertices.clear();
    complex.append_input_cell(dim, {cell.id}, vertices);
    for (const Index v : vertices) numbers.push_back(number_of(v, ids));
    values.push_back(static_cast<float>(cell.value));
  }
  return missing_from;
}

template <class Listed>
ComplexArrays arrays_of(const Listed& complex, std::size_t count, std::span<const Index> ids,
                        const RunContext& context) {
  ComplexArrays arrays;
  arrays.births.assign(count, std::numeric_limits<float>::quiet_NaN());
  std::vector<Index> vertex;
  complex.for_each_cell(0, [&](ExplicitComplex::Cell cell) {
    vertex.clear();
    complex.append_input_cell(0, cell, vertex);
    arrays.births[static_cast<std::size_t>(vertex[0])] = static_cast<float>(complex.value(cell));
  });
  arrays.missing_from =
      add_first(complex, 1, kMostEdges, ids, context, arrays.edges, arrays.edge_values);
  arrays.triangles_missing_from =
      add_first(complex, 2, kMostTriangles, ids, context, arrays.triangles, arrays.triangle_values);
  return arrays;
}

ComplexArrays arrays_of(const RipsGraph& graph, std::size_t count, std::span<const Index> ids) {
  ComplexArrays arrays;
  if (!graph.births().empty()) {
    arrays.births.assign(count, std::numeric_limits<float>::quiet_NaN());
    for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(graph.size()); ++v)
      arrays.births[static_cast<std::size_t>(graph.name(v))] = static_cast<float>(graph.birth(v));
  }
  if (graph.is_forest() || graph.points_alone()) return arrays;
  const auto number = [&](std::uint32_t v) { return number_of(graph.name(v), ids); };
  const std::size_t shown = std::min(graph.edge_count(), kMostEdges);
  for (std::size_t i = 0; i < shown; ++i) {
    const FlagEdge& edge = graph.edge(static_cast<RipsGraph::Key>(i + 1));
    arrays.edges.insert(arrays.edges.end(), {number(edge.v), number(edge.u)});
    arrays.edge_values.push_back(static_cast<float>(edge.value));
  }
  if (shown < graph.edge_count())
    arrays.missing_from = graph.value(static_cast<RipsGraph::Key>(shown + 1));
  return arrays;
}

}  // namespace

ComplexArrays complex_arrays(const AnyComplex& complex, std::optional<RipsForm> form,
                             std::size_t count, std::span<const Index> ids,
                             const RunContext& context) {
  const MemoryClaim claim(context.memory, count * sizeof(float) + 16 * kMostEdges);
  if (const auto* rips = std::get_if<Rips>(&complex))
    return arrays_of(rips->graph(form.value_or(RipsForm::edges), context), count, ids);
  if (const auto* listed = std::get_if<ExplicitComplex>(&complex))
    return arrays_of(*listed, count, ids, context);
  // An edge that crosses the boundary of a periodic space would be drawn across the whole space.
  if (const auto* alpha = std::get_if<Alpha>(&complex); alpha && !alpha->is_periodic()) {
    alpha->prepare(context);
    return arrays_of(*alpha, count, ids, context);
  }
  return {};
}

void add_complex(ReportFile& report, const ComplexArrays& arrays) {
  if (!arrays.births.empty()) report.add("points/birth", arrays.births);
  const auto add = [&](const char* cells, const char* values, std::size_t arity,
                       const std::vector<std::uint32_t>& numbers, const std::vector<float>& of) {
    if (of.empty()) return;
    report.add(cells, numbers, {.shape = {of.size(), arity}});
    report.add(values, of);
  };
  add("complex/edges", "complex/edge_values", 2, arrays.edges, arrays.edge_values);
  add("complex/triangles", "complex/triangle_values", 3, arrays.triangles, arrays.triangle_values);
}

}  // namespace ph::report
