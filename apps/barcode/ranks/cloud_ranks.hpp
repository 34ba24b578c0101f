// SPDX-License-Identifier: MIT
#pragma once
#include "barcode/ranks/rank_result.hpp"
#include "facade/parts/transport.hpp"

namespace ph::barcode {

/// Computes the components of a point cloud on all ranks, some blocks of it on each.
/// @throws Error (usage) as read_cloud_input.
RankResult cloud_of_ranks(const Job& job, const Arguments& arguments, Transport& transport,
                          app::Session& session);

}  // namespace ph::barcode
