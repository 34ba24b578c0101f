// SPDX-License-Identifier: MIT
#include "ph/detail/rips/sparse_rips.hpp"

#include <fmt/format.h>

#include "ph/error.hpp"

namespace ph {

void SparseRips::check_epsilon(double epsilon) {
  if (!(epsilon > 0 && epsilon <= std::numeric_limits<double>::max())) {
    throw Error(
        ErrorKind::usage,
        fmt::format("sparse Rips: found epsilon {}, expected a finite number above 0", epsilon));
  }
}

SparseRips::SparseRips(const GreedyPermutation& order, Index size, double epsilon,
                       const RunContext& context)
    : epsilon_(epsilon), largest_ball_(static_cast<std::size_t>(size), 0.0, &context.memory) {
  check_epsilon(epsilon);
  // The permutation leaves out copies of points, whose balls never grow.
  for (std::size_t k = 0; k < order.points.size(); ++k)
    // mutant: sparse-largest-ball
    if (order.radii[k] > 0) largest_ball_[order.points[k]] = 2 * order.radii[k] * (1 + 1 / epsilon);
}

}  // namespace ph
