// SPDX-License-Identifier: MIT
#pragma once
#include "apps/barcode/arguments/arguments.hpp"
#include "apps/barcode/job/job.hpp"
#include "apps/common/run/program.hpp"
#include "apps/common/run/session.hpp"

namespace ph::barcode {

inline constexpr app::Program kProgram{"ph-barcode",
                                       "use fewer points or voxels, a lower threshold or dimension "
                                       "(--max-dim), or raise --memory-limit"};

/// Reads one input, computes its barcode and writes it. A stored barcode is only read and written.
/// @throws Error.
Outcome run(const Job& job, app::Session& session);

}  // namespace ph::barcode
