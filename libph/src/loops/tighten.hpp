// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/detail/rips/rips_graph.hpp"
#include "ph/loops.hpp"

namespace ph::detail {

/// Measures the loops of a Rips filtration, which are its cycles split into closed walks. If
/// `tighten` is set and memory allows it, replaces the loops by shorter loops.
void measure_and_tighten(const RipsGraph& graph, const Barcode& cycles, const Options& options,
                         bool tighten, std::vector<BarLoops>& loops, const RunContext& context);

}  // namespace ph::detail
