// SPDX-License-Identifier: MIT
// Single-linkage clustering of many points: computes the merge tree, and cuts it where the gap
// between merges is widest.
#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <ph/merge_tree.hpp>
#include <ph/ph.hpp>

int main() {
  // Three spirals of 40 000 points each, one point after another.
  constexpr ph::Index spirals = 3, length = 40000;
  ph::Points points(spirals * length, 2);
  for (ph::Index i = 0; i < points.rows(); ++i) {
    const double t = 1 + static_cast<double>(i / spirals) / 4000;
    const double angle = t + 2 * std::numbers::pi * static_cast<double>(i % spirals) / spirals;
    points.set_row(i, {t * std::cos(angle), t * std::sin(angle)});
  }

  // Only the distances that are needed for the components are computed.
  const ph::MergeTree tree = ph::merge_tree(ph::Rips(points));
  const auto rows = ph::linkage(tree);
  std::cout << "last merges at " << rows[rows.size() - 2].value << " and " << rows.back().value
            << ", the one before at " << rows[rows.size() - 3].value << "\n";

  std::map<ph::Index, int> sizes;  // a cluster has the number of its first point
  for (const ph::Index cluster : tree.components(rows[rows.size() - 3].value)) ++sizes[cluster];
  for (const auto& [first, size] : sizes)
    std::cout << "cluster of point " << first << ": " << size << " points\n";
}
