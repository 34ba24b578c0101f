// SPDX-License-Identifier: MIT
#pragma once
#include "barcode/arguments/arguments.hpp"
#include "barcode/ranks/rank_result.hpp"
#include "barcode/run.hpp"
#include "facade/parts/transport.hpp"

namespace ph::barcode {

/// Computes an image on all ranks, or with --dry-run says what they will take.
RankResult image_of_ranks(const Job& job, const Arguments& arguments, Transport& transport,
                          app::Session& session);

}  // namespace ph::barcode
