// SPDX-License-Identifier: MIT
#include "libsegment/src/tree/cross_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "ph/detail/core/barcode_builder.hpp"
#include "ph/detail/reduction/twist.hpp"

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

std::string cross_check(const FilteredGraph& graph, const Barcode& barcode,
                        const RunContext& context) {
  BarcodeBuilder<FilteredGraph> bars(graph, 0, -1);  // this includes zero-length bars
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
