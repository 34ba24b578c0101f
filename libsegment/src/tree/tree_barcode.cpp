// SPDX-License-Identifier: MIT
#include "tree/tree_barcode.hpp"

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

}  // namespace ph::segment
