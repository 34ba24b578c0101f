// SPDX-License-Identifier: MIT
#include "ph/detail/segment/tree_barcode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

namespace ph::segment {

Barcode barcode_of(const MergeTree& tree) {
  Barcode barcode(CellKind::vertices);
  for (const auto& [birth, death, vertex, merge] : tree.classes()) {
    std::array<Index, 2> edge{};
    if (merge >= 0) {
      const Merge& m = tree.merges[static_cast<std::size_t>(merge)];
      edge = {std::min(m.u, m.v), std::max(m.u, m.v)};
    }
    barcode.add({0, birth, death}, {&vertex, 1},
                std::span<const Index>(edge).first(merge < 0 ? 0 : 2));
  }
  return barcode;
}

BarcodeInfo info_of_barcode(const Segmentation& s) {
  BarcodeInfo info;
  info.input_description = fmt::format("{} voxel centroids in R^3", s.tree.vertices.rows());
  const bool paper = s.tree.method == Method::paper;
  info.complex = paper ? "rips" : "lower-star";
  if (paper) {
    info.threshold = s.tree.distance;
    info.metric = metric_name(PointDistance::euclidean);
  }
  info.engine = "union-find";
  for (const Stage& stage : s.stages) info.timings.emplace_back(stage.name, stage.seconds);
  return info;
}

}  // namespace ph::segment
