// SPDX-License-Identifier: MIT
#include "cross_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "ph/core/radix_sort.hpp"
#include "ph/engine/twist.hpp"

namespace ph::segment {
namespace {

std::string in_words(const Barcode& barcode, std::size_t i) {
  const Bar& bar = barcode[i];
  const Index vertex = barcode.birth_cell(i).numbers[0];
  const std::optional<InputCell> edge = barcode.death_cell(i);
  if (!edge) return fmt::format("[{}, inf) of vertex {}", bar.birth, vertex);
  return fmt::format("[{}, {}) of vertex {} and edge {}-{}", bar.birth, bar.death, vertex,
                     edge->numbers[0], edge->numbers[1]);
}

bool same_cells(const std::optional<InputCell>& a, const std::optional<InputCell>& b) {
  if (!a || !b) return !a && !b;
  return std::ranges::equal(a->numbers, b->numbers);
}

}  // namespace

Barcode barcode_of(const MergeTree& tree) {
  struct Class {
    double birth, death;
    Index vertex;
    const Merge* merge;  // null: it never dies
  };
  std::vector<Class> classes;
  classes.reserve(tree.births.size());
  std::vector<bool> dead(tree.births.size());
  for (const Merge& m : tree.merges) {
    classes.push_back({m.younger_birth, m.value, m.younger, &m});
    dead[static_cast<std::size_t>(m.younger)] = true;
  }
  for (std::size_t v = 0; v < dead.size(); ++v)
    if (!dead[v] && tree.births[v] != kInfinity)
      classes.push_back({tree.births[v], kInfinity, static_cast<Index>(v), nullptr});
  // The order of a barcode: three numbers decide it here, and the merges are in that of deaths.
  radix_sort_by_value(classes, [](const Class& c) { return c.birth + 0.0; });
  for (auto begin = classes.begin(), end = begin; begin != classes.end(); begin = end) {
    end = std::find_if(begin, classes.end(), [&](const Class& c) {
      return c.birth != begin->birth || c.death != begin->death;
    });
    std::sort(begin, end, [](const Class& a, const Class& b) { return a.vertex < b.vertex; });
  }

  Barcode barcode(CellKind::vertices);
  for (const auto& [birth, death, vertex, merge] : classes) {
    std::array<Index, 2> edge{};
    if (merge != nullptr) edge = {std::min(merge->u, merge->v), std::max(merge->u, merge->v)};
    barcode.add({0, birth, death}, {&vertex, 1},
                std::span<const Index>(edge).first(merge == nullptr ? 0 : 2));
  }
  return barcode;
}

std::string cross_check(const FilteredGraph& graph, const Barcode& barcode,
                        const RunContext& context) {
  BarcodeBuilder<FilteredGraph> bars(graph, 0, -1);  // zero-length bars, too
  TwistEngine::run(graph, Z2{}, bars, context);
  const Barcode other = bars.finish();
  if (barcode.size() != other.size()) {
    return fmt::format("{} bars by union-find, {} by boundary-matrix reduction", barcode.size(),
                       other.size());
  }
  for (std::size_t i = 0; i < barcode.size(); ++i) {
    if (barcode[i] == other[i] && same_cells(barcode.birth_cell(i), other.birth_cell(i)) &&
        same_cells(barcode.death_cell(i), other.death_cell(i))) {
      continue;
    }
    return fmt::format("{} by union-find, {} by boundary-matrix reduction", in_words(barcode, i),
                       in_words(other, i));
  }
  return {};
}

}  // namespace ph::segment
