// SPDX-License-Identifier: MIT
#include "ph/explicit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <numeric>
#include <vector>

#include "libph/src/complex/counted_list.hpp"
#include "ph/detail/core/polled_sort.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

constexpr std::size_t kMostVertices = 24;  // a simplex has up to 2^24 faces

/// Simplices with the same number of vertices, one after another. The vertices of each simplex
/// ascend. A few large blocks of memory return to the system at once, unlike many small ones.
class Rows {
 public:
  Rows(std::size_t width, const RunContext& context) : width_(width), numbers_(&context.memory) {}

  std::size_t size() const { return numbers_.size() / width_; }
  std::span<const Index> operator[](std::size_t i) const {
    return std::span(numbers_).subspan(i * width_, width_);
  }
  void reserve(std::size_t rows) { numbers_.reserve(rows * width_); }
  void add(std::span<const Index> row) { numbers_.insert(numbers_.end(), row.begin(), row.end()); }

  /// Sorts the rows in lexicographic order, and keeps each row once.
  void make_unique(const RunContext& context) {
    const std::size_t count = size();
    if (count > std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorKind::resource,
                  fmt::format("lower star: found {} faces of {} vertices, expected fewer than 2^32",
                              count, width_));
    std::pmr::vector<std::uint32_t> order(count, &context.memory);
    std::iota(order.begin(), order.end(), 0U);
    Ticker ticker(context, {});
    polled_sort(
        order,
        [&](std::uint32_t a, std::uint32_t b) {
          return std::ranges::lexicographical_compare((*this)[a], (*this)[b]);
        },
        ticker);
    const auto last =
        std::unique(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
          return std::ranges::equal((*this)[a], (*this)[b]);
        });
    Rows sorted(width_, context);
    sorted.reserve(static_cast<std::size_t>(last - order.begin()));
    for (auto at = order.begin(); at != last; ++at) sorted.add((*this)[*at]);
    numbers_ = std::move(sorted.numbers_);
  }

 private:
  std::size_t width_;
  std::pmr::vector<Index> numbers_;
};

/// Sorted copies of the simplices, by their number of vertices. Item 0 is empty.
std::vector<Rows> rows_of(const SimplexList& simplices, Index vertex_count, const CellNamer& name,
                          const RunContext& context) {
  std::vector<Rows> rows;
  rows.emplace_back(1, context);
  std::vector<Index> vertices;
  Ticker ticker(context, {});
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    ticker.tick();
    const auto given = simplices.simplex(i);
    const auto where = [&] { return mark_place(name ? name(i) : fmt::format("simplex {}", i)); };
    vertices.assign(given.begin(), given.end());
    std::sort(vertices.begin(), vertices.end());
    for (const Index v : vertices) {
      if (v < 0 || v >= vertex_count) {
        throw Error(ErrorKind::bad_data,
                    fmt::format("{}: vertex {} has no value, expected vertices >= 0 and below {}, "
                                "the number of values",
                                where(), v, vertex_count));
      }
    }
    if (std::adjacent_find(vertices.begin(), vertices.end()) != vertices.end())
      throw Error(ErrorKind::bad_data, where() + ": a vertex occurs twice in one simplex");
    if (vertices.size() > kMostVertices) {
      throw Error(ErrorKind::resource, fmt::format("{}: found {} vertices, expected at most {}",
                                                   where(), vertices.size(), kMostVertices));
    }
    while (rows.size() <= vertices.size()) rows.emplace_back(rows.size(), context);
    // Each vertex with a value is a simplex, whether it is listed or not.
    if (vertices.size() > 1) rows[vertices.size()].add(vertices);
  }
  return rows;
}

/// Adds the faces of all simplices, largest simplices first: each simplex adds its facets, and
/// these add theirs.
void add_faces(std::vector<Rows>& rows, const RunContext& context) {
  std::vector<Index> facet;
  for (std::size_t width = rows.size() - 1; width >= 2; --width) {
    rows[width].make_unique(context);
    if (width == 2) break;
    Rows& facets = rows[width - 1];
    facets.reserve(facets.size() + rows[width].size() * width);
    for (std::size_t i = 0; i < rows[width].size(); ++i) {
      const auto simplex = rows[width][i];
      for (std::size_t left_out = 0; left_out < width; ++left_out) {
        facet.assign(simplex.begin(), simplex.end());
        facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(left_out));
        facets.add(facet);
      }
    }
  }
}

/// All simplices in lexicographic order, with the largest value of their vertices.
SimplexList list_of(const std::vector<Rows>& rows, std::span<const double> vertex_values,
                    const RunContext& context) {
  std::size_t count = vertex_values.size(), vertices = count;
  for (std::size_t width = 2; width < rows.size(); ++width) {
    count += rows[width].size();
    vertices += rows[width].size() * width;
  }
  CountedList list(count, vertices, context);
  std::vector<std::size_t> next(rows.size(), 0);
  for (Index v = 0; v < static_cast<Index>(vertex_values.size()); ++v) {
    list.add(std::array{v}, vertex_values[static_cast<std::size_t>(v)]);
    // All simplices whose first vertex is v follow.
    for (;;) {
      std::size_t least = 0;
      for (std::size_t width = 2; width < rows.size(); ++width) {
        if (next[width] == rows[width].size() || rows[width][next[width]][0] != v) continue;
        if (least == 0 || std::ranges::lexicographical_compare(rows[width][next[width]],
                                                               rows[least][next[least]]))
          least = width;
      }
      if (least == 0) break;
      const auto simplex = rows[least][next[least]++];
      double value = -std::numeric_limits<double>::infinity();
      for (const Index u : simplex)
        value = std::max(value, vertex_values[static_cast<std::size_t>(u)]);
      list.add(simplex, value);
    }
  }
  return list.take();
}

}  // namespace

ExplicitComplex lower_star(const SimplexList& simplices, std::span<const double> vertex_values,
                           const CellNamer& name, const RunContext& context) {
  simplices.check_layout();
  const auto vertex_count = static_cast<Index>(vertex_values.size());
  std::vector<Rows> rows = rows_of(simplices, vertex_count, name, context);
  add_faces(rows, context);
  for (Index v = 0; v < vertex_count; ++v) {
    if (std::isnan(vertex_values[static_cast<std::size_t>(v)])) {
      throw Error(ErrorKind::bad_data,
                  fmt::format("vertex {}: found the value nan, expected a number", v));
    }
  }
  SimplexList list = list_of(rows, vertex_values, context);
  rows.clear();
  return ExplicitComplex::from_simplices(std::move(list), {}, context);
}

ExplicitComplex lower_star(std::span<const WeightedEdge> edges,
                           std::span<const double> vertex_values, const RunContext& context) {
  SimplexList list;
  for (const WeightedEdge& e : edges) list.add(std::array{e.u, e.v}, 0);
  return lower_star(list, vertex_values, {}, context);
}

}  // namespace ph
