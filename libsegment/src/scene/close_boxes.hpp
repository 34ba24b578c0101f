// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "ph/run_context.hpp"

namespace ph::segment {

/// A part with the box of all or some of its voxels.
template <int Dim>
struct PartBox {
  std::uint32_t part;
  Eigen::AlignedBox<double, Dim> box;  ///< not empty
};

/// Calls `visit(p, q)`, with p > q, for each pair of parts whose boxes are closer than both
/// `reach(p)` and `reach(q)`. The function sweeps along x, and compares a box only with boxes that
/// are close enough along this axis.
template <int Dim, class Reach, class Visit>
void for_each_close_pair(std::vector<PartBox<Dim>> boxes, Reach&& reach, const RunContext& context,
                         Visit&& visit) {
  const auto begin = [](const PartBox<Dim>& b) { return b.box.min()[0]; };
  std::ranges::stable_sort(boxes, {}, begin);
  Ticker ticker(context, "objects", boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const PartBox<Dim>& a = boxes[i];
    const double end = a.box.max()[0] + reach(a);
    for (std::size_t k = i + 1; k < boxes.size() && begin(boxes[k]) <= end; ++k) {
      const PartBox<Dim>& b = boxes[k];
      const double most = std::min(reach(a), reach(b));
      ticker.work();
      if (!(a.box.squaredExteriorDistance(b.box) < most * most)) continue;
      visit(std::max(a.part, b.part), std::min(a.part, b.part));
    }
    ticker.tick();
  }
}

}  // namespace ph::segment
