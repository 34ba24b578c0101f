// SPDX-License-Identifier: MIT
#include "ph/complex/filtered_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ph/core/error.hpp"
#include "ph/core/radix_sort.hpp"

namespace ph {

FilteredGraph::FilteredGraph(std::span<const double> births, std::span<const WeightedEdge> edges,
                             const RunContext& context)
    : births_(births.begin(), births.end(), &context.memory), edges_(&context.memory) {
  if (births.size() + edges.size() >= UINT32_MAX) {
    throw Error(ErrorKind::resource,
                fmt::format("graph: found {} vertices and {} edges, expected fewer than 2^32 - 1 "
                            "cells",
                            births.size(), edges.size()));
  }
  for (std::size_t v = 0; v < births_.size(); ++v) {
    if (std::isnan(births_[v]))
      throw Error(ErrorKind::bad_data, fmt::format("vertex {}: found the value nan", v));
    births_[v] += 0.0;
  }
  edges_.reserve(edges.size());
  for (const WeightedEdge& e : edges) {
    const auto [u, v] = std::minmax(e.u, e.v);
    if (u < 0 || v >= size()) {
      throw Error(ErrorKind::bad_data,
                  fmt::format("edge ({}, {}): expected vertices below {}", e.u, e.v, size()));
    }
    const double last_end =
        std::max(births_[static_cast<std::size_t>(u)], births_[static_cast<std::size_t>(v)]);
    if (!(e.value >= last_end)) {
      throw Error(ErrorKind::bad_data, fmt::format("edge ({}, {}): found the value {}, expected at "
                                                   "least that of its ends, {}",
                                                   e.u, e.v, e.value, last_end));
    }
    edges_.push_back({static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(v), e.value + 0.0});
  }
  radix_sort_by_value(edges_, [](const Edge& e) { return e.value; });
}

FilteredGraph FilteredGraph::lower_star(std::span<const double> vertex_values,
                                        std::span<const WeightedEdge> edges,
                                        const RunContext& context) {
  const auto value_of = [&](Index v) {
    const bool is_vertex = v >= 0 && v < static_cast<Index>(vertex_values.size());
    return is_vertex ? vertex_values[static_cast<std::size_t>(v)] : 0.0;
  };
  std::vector<WeightedEdge> valued(edges.begin(), edges.end());
  for (WeightedEdge& e : valued) e.value = std::max(value_of(e.u), value_of(e.v));
  return FilteredGraph(vertex_values, valued, context);
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
