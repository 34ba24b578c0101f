// SPDX-License-Identifier: MIT
#pragma once
#include "rips/make_graph.hpp"

namespace ph {

/// The same as Rips::sample.
RipsSample sample_of(const RipsData& data, const RipsOptions& options, const RunContext& context);

}  // namespace ph
