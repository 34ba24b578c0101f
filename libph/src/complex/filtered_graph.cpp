// SPDX-License-Identifier: MIT
#include "ph/detail/complex/filtered_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ph/barcode.hpp"
#include "ph/detail/core/radix_sort.hpp"
#include "ph/error.hpp"

namespace ph {

FilteredGraph::FilteredGraph(std::span<const double> births, std::size_t edge_count,
                             const RunContext& context)
    : births_(births.begin(), births.end(), &context.memory), edges_(&context.memory) {
  if (births.size() + edge_count >= UINT32_MAX) {
    throw Error(ErrorKind::resource,
                fmt::format("graph: found {} vertices and {} edges, expected fewer than 2^32 - 1 "
                            "of both together",
                            births.size(), edge_count));
  }
  for (std::size_t v = 0; v < births_.size(); ++v) {
    if (std::isnan(births_[v]))
      throw Error(ErrorKind::bad_data, fmt::format("vertex {}: found the value nan", v));
    births_[v] += 0.0;
    none_enters_ = none_enters_ && births_[v] == kInfinity;
  }
  edges_.reserve(edge_count);
}

FilteredGraph::Edge FilteredGraph::edge_between(const WeightedEdge& e) const {
  const Index u = std::min(e.u, e.v), v = std::max(e.u, e.v);
  if (u < 0 || v >= size()) {
    throw Error(
        ErrorKind::bad_data,
        fmt::format("edge ({}, {}): expected vertices >= 0 and below {}", e.u, e.v, size()));
  }
  return {static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(v),
          std::max(births_[static_cast<std::size_t>(u)], births_[static_cast<std::size_t>(v)])};
}

FilteredGraph::FilteredGraph(std::span<const double> births, std::span<const WeightedEdge> edges,
                             const RunContext& context)
    : FilteredGraph(births, edges.size(), context) {
  for (const WeightedEdge& e : edges) {
    Edge edge = edge_between(e);
    if (!(e.value >= edge.value)) {
      throw Error(ErrorKind::bad_data, fmt::format("edge ({}, {}): found the value {}, expected at "
                                                   "least the value of its ends, {}",
                                                   e.u, e.v, e.value, edge.value));
    }
    edge.value = e.value + 0.0;
    edges_.push_back(edge);
  }
  const auto value_of = [](const Edge& e) { return e.value; };
  if (!std::ranges::is_sorted(edges_, {}, value_of)) radix_sort_by_value(edges_, value_of, context);
  leave_out_what_never_enters();
}

FilteredGraph FilteredGraph::lower_star(std::span<const double> vertex_values,
                                        std::span<const WeightedEdge> edges,
                                        const RunContext& context) {
  FilteredGraph graph(vertex_values, edges.size(), context);
  const auto& births = graph.births_;
  // An edge has the value of one of its vertices. To sort the edges, it is therefore enough to sort
  // the vertices, which are fewer.
  std::pmr::vector<std::uint32_t> order(births.size(), &context.memory);
  std::iota(order.begin(), order.end(), 0U);
  radix_sort_by_value(
      order, [&](std::uint32_t v) { return births[v]; }, context);
  std::pmr::vector<std::uint32_t> place_of_value(births.size(), &context.memory);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const std::uint32_t before = order[i - 1], v = order[i];
    place_of_value[v] = place_of_value[before] + (births[before] < births[v] ? 1 : 0);
  }
  const auto place_of = [&](const Edge& e) {
    return std::max(place_of_value[e.u], place_of_value[e.v]);
  };
  std::pmr::vector<std::uint32_t> next(births.size() + 1, &context.memory);
  for (const WeightedEdge& e : edges) ++next[place_of(graph.edge_between(e)) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  graph.edges_.resize(edges.size());
  for (const WeightedEdge& e : edges) {
    const Edge edge = graph.edge_between(e);
    graph.edges_[next[place_of(edge)]++] = edge;
  }
  graph.leave_out_what_never_enters();
  return graph;
}

void FilteredGraph::leave_out_what_never_enters() {
  while (!edges_.empty() && edges_.back().value == kInfinity) edges_.pop_back();
}

void FilteredGraph::append_input_cell(int dim, Cell cell, std::vector<Index>& numbers) const {
  if (dim == 0) {
    numbers.push_back(cell);
  } else {
    const Edge& e = edges_[cell - births_.size()];
    numbers.insert(numbers.end(), {e.u, e.v});
  }
}

}  // namespace ph
