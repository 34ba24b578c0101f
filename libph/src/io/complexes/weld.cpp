// SPDX-License-Identifier: MIT
// Finds the vertices of a mesh that lie at the same position, and joins them.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/io/read.hpp"

namespace ph::detail {
namespace {

// For each vertex, the first vertex at its position.
std::vector<Index> first_at_position(const Points& vertices) {
  std::vector<Index> order(static_cast<std::size_t>(vertices.rows()));
  std::iota(order.begin(), order.end(), Index{0});
  const auto position = [&](Index i) {
    return std::span(vertices.data() + i * vertices.cols(),
                     static_cast<std::size_t>(vertices.cols()));
  };
  const auto is_same = [&](Index i, Index j) {
    return std::ranges::equal(position(i), position(j));
  };
  std::ranges::sort(order, [&](Index i, Index j) {
    return is_same(i, j) ? i < j : std::ranges::lexicographical_compare(position(i), position(j));
  });
  std::vector<Index> first(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto i = static_cast<std::size_t>(order[k]);
    const bool is_first = k == 0 || !is_same(order[k - 1], order[k]);
    first[i] = is_first ? order[k] : first[static_cast<std::size_t>(order[k - 1])];
  }
  return first;
}

}  // namespace

std::string note_on_seams(const Mesh& mesh, const Input& input) {
  input.require_memory(static_cast<std::size_t>(mesh.vertices.rows()) * 3 * sizeof(Index));
  const std::vector<Index> first = first_at_position(mesh.vertices);
  std::vector<bool> has_face(first.size(), false);
  for (const Index corner : mesh.corners) has_face[static_cast<std::size_t>(corner)] = true;
  std::vector<bool> is_taken(first.size(), false), is_split(first.size(), false);
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (!has_face[i]) continue;
    const auto place = static_cast<std::size_t>(first[i]);
    if (is_taken[place]) is_split[place] = true;
    is_taken[place] = true;
  }
  const auto positions = std::ranges::count(is_split, true);
  if (positions == 0) return {};
  return fmt::format(
      "{} several vertices each, so faces that meet there are not connected; {} joins them",
      positions == 1 ? "1 position has" : fmt::format("{} positions have", positions),
      mark(Setting::weld));
}

std::vector<Index> weld(Mesh& mesh, const Input& input) {
  input.require_memory(static_cast<std::size_t>(mesh.vertices.rows()) * 4 * sizeof(Index));
  const std::vector<Index> first = first_at_position(mesh.vertices);
  std::vector<Index> kept, number(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto place = static_cast<std::size_t>(first[i]);
    if (place == i) {
      number[i] = static_cast<Index>(kept.size());
      kept.push_back(first[i]);
    } else if (!mesh.values.empty() && mesh.values[i] != mesh.values[place]) {
      input.fail({"vertices at the same position",
                  fmt::format("the values {} of vertex {} and {} of vertex {}", mesh.values[place],
                              place, mesh.values[i], i),
                  "equal values for " + mark(Setting::weld),
                  {}});
    }
  }
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Index i = kept[k];
    std::copy_n(mesh.vertices.data() + i * 3, 3, mesh.vertices.data() + k * 3);
    if (!mesh.values.empty()) mesh.values[k] = mesh.values[static_cast<std::size_t>(i)];
  }
  mesh.vertices.keep_rows(static_cast<Index>(kept.size()));
  if (!mesh.values.empty()) mesh.values.resize(kept.size());
  // A face may have two corners at one position. It keeps one of two equal corners in a row.
  std::vector<Index> corners;
  std::vector<std::size_t> offsets{0};
  corners.reserve(mesh.corners.size());
  offsets.reserve(mesh.offsets.size());
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const std::size_t start = corners.size();
    for (std::size_t k = mesh.offsets[f]; k < mesh.offsets[f + 1]; ++k) {
      const auto corner = static_cast<std::size_t>(mesh.corners[k]);
      const Index welded = number[static_cast<std::size_t>(first[corner])];
      if (corners.size() == start || corners.back() != welded) corners.push_back(welded);
    }
    while (corners.size() > start + 1 && corners.back() == corners[start]) corners.pop_back();
    offsets.push_back(corners.size());
  }
  mesh.corners = std::move(corners);
  mesh.offsets = std::move(offsets);
  return kept;
}

}  // namespace ph::detail
