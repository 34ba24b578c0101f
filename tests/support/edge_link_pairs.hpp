// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <vector>

#include "libph/src/rips/edge_links.hpp"
#include "tests/support/conformance.hpp"

namespace ph::test {

/// The pairs that the sweep of edge links finds with the code for large inputs.
template <class F>
std::vector<Pair> pairs_of_edge_links(const F& f, int max_dim, std::int64_t field,
                                      SweepTuning tuning, double min_persistence) {
  const RunContext context;
  BarcodeBuilder<F> bars(f, max_dim, min_persistence);
  detail::with_field(field,
                     [&](const auto& k) { EdgeLinkEngine::run(f, k, bars, context, tuning); });
  return pairs_of(bars.finish());
}

}  // namespace ph::test
