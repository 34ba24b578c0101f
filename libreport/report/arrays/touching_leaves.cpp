// SPDX-License-Identifier: MIT
#include "libreport/report/arrays/tree_arrays.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace ph::report {

std::vector<std::uint32_t> touching_in_picture(std::span<const std::uint32_t> index,
                                               std::span<const std::uint32_t> leaf,
                                               std::size_t width) {
  constexpr std::size_t widest_gap = 8;  // in pixels
  struct Seen {
    std::uint32_t leaf = kNone;
    std::size_t place = 0;  // the column or the row
  };
  Seen left;                       // the last leaf seen in this row
  std::vector<Seen> above(width);  // the last leaf seen in each column
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  const auto meet = [&](Seen& last, const Seen& here) {
    if (last.leaf != kNone && last.leaf != here.leaf && here.place - last.place <= widest_gap)
      pairs.insert(std::minmax(last.leaf, here.leaf));
    last = here;
  };
  std::size_t row = 0;
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (leaf[i] == kNone) continue;
    if (index[i] / width != row) {
      row = index[i] / width;
      left = {};
    }
    const std::size_t column = index[i] % width;
    meet(left, {leaf[i], column});
    meet(above[column], {leaf[i], row});
  }
  std::vector<std::uint32_t> flat;
  flat.reserve(2 * pairs.size());
  for (const auto& [a, b] : pairs) flat.insert(flat.end(), {a, b});
  return flat;
}

}  // namespace ph::report
