// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>

#include "barcode/run.hpp"
#include "facade/parts/post.hpp"

namespace ph::barcode {

/// The bars of all ranks, and what JSON says of them.
struct RankBars {
  Barcode bars;
  BarcodeInfo info;
};

/// What a rank has when all of them are joined.
struct RankResult {
  std::string kept;              ///< where --resume keeps the part of this rank; empty: nowhere
  std::optional<RankBars> bars;  ///< on rank 0
};

/// Where --resume keeps the part of a rank.
std::string kept_path(const Arguments& arguments, int rank, int parts);

/// What --verbose says of a rank that is done.
void explain_costs(const Post& post, app::Session& session);

}  // namespace ph::barcode
