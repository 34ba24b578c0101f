// SPDX-License-Identifier: MIT
#include "ph/explicit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <set>
#include <vector>

#include "ph/error.hpp"

namespace ph {
namespace {

constexpr std::size_t kMostVertices = 24;  // a simplex has up to 2^24 faces

using Closure = std::pmr::set<std::pmr::vector<Index>>;

ExplicitComplex lower_star_of(Closure simplices, std::span<const double> vertex_values,
                              const RunContext& context) {
  SimplexList list;
  for (Index v = 0; v < static_cast<Index>(vertex_values.size()); ++v) {
    const double value = vertex_values[static_cast<std::size_t>(v)];
    if (std::isnan(value)) {
      throw Error(ErrorKind::bad_data,
                  fmt::format("vertex {}: found the value nan, expected a number", v));
    }
    simplices.emplace(1, v);
  }
  for (const auto& simplex : simplices) {
    double value = -std::numeric_limits<double>::infinity();
    for (const Index v : simplex)
      value = std::max(value, vertex_values[static_cast<std::size_t>(v)]);
    list.add(simplex, value);
  }
  return ExplicitComplex::from_simplices(std::move(list), {}, context);
}

}  // namespace

ExplicitComplex lower_star(const SimplexList& simplices, std::span<const double> vertex_values,
                           const CellNamer& name, const RunContext& context) {
  simplices.check_layout();
  Closure closure(&context.memory);
  std::pmr::vector<Index> face;
  std::size_t looked_at = 0;
  const auto poll = [&] {
    if (++looked_at % 4096 == 0) context.poll();
  };
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    poll();
    const auto given = simplices.simplex(i);
    const auto where = [&] { return mark_place(name ? name(i) : fmt::format("simplex {}", i)); };
    std::pmr::vector<Index> vertices(given.begin(), given.end());
    std::sort(vertices.begin(), vertices.end());
    for (const Index v : vertices) {
      if (v < 0 || v >= static_cast<Index>(vertex_values.size())) {
        throw Error(ErrorKind::bad_data,
                    fmt::format("{}: vertex {} has no value, expected vertices >= 0 and below {}, "
                                "the number of values",
                                where(), v, vertex_values.size()));
      }
    }
    if (std::adjacent_find(vertices.begin(), vertices.end()) != vertices.end())
      throw Error(ErrorKind::bad_data, where() + ": a vertex occurs twice in one simplex");
    if (vertices.size() > kMostVertices) {
      throw Error(ErrorKind::resource, fmt::format("{}: found {} vertices, expected at most {}",
                                                   where(), vertices.size(), kMostVertices));
    }
    if (closure.contains(vertices)) continue;  // all faces of the simplex are present as well
    for (std::size_t mask = 1; mask < (std::size_t{1} << vertices.size()); ++mask) {
      poll();
      face.clear();
      for (std::size_t k = 0; k < vertices.size(); ++k)
        if (mask >> k & 1) face.push_back(vertices[k]);
      closure.insert(face);
    }
  }
  return lower_star_of(std::move(closure), vertex_values, context);
}

ExplicitComplex lower_star(std::span<const WeightedEdge> edges,
                           std::span<const double> vertex_values, const RunContext& context) {
  SimplexList list;
  for (const WeightedEdge& e : edges) list.add(std::array{e.u, e.v}, 0);
  return lower_star(list, vertex_values, {}, context);
}

}  // namespace ph
