// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <utility>

#include "barcode/parts/part_files.hpp"
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

/// Computes an image on all ranks, or with --dry-run says what they will take.
RankResult image_of_ranks(const Job& job, const Arguments& arguments, Transport& transport,
                          app::Session& session);
/// Computes the components of a point cloud on all ranks, some blocks of it on each.
/// @throws Error (usage) as read_cloud_input.
RankResult cloud_of_ranks(const Job& job, const Arguments& arguments, Transport& transport,
                          app::Session& session);

/// Where --resume keeps the part of a rank.
std::string kept_path(const Arguments& arguments, int rank, int parts);

/// The part of this rank: with --resume taken from its file, if `find_kept` finds it there; else
/// `compute` makes it, and with --resume it is written there.
/// @param find_kept gives an optional part. @param compute gives a part.
/// @param can_keep says whether a file can stand for a part.
template <class FindKept, class Compute, class CanKeep>
auto kept_or_computed(const std::string& kept, const Arguments& arguments, app::Session& session,
                      FindKept&& find_kept, Compute&& compute, CanKeep&& can_keep) {
  if (arguments.resumes) {
    if (auto there = find_kept(); there && can_keep(*there)) {
      session.explain(kept + " is there already");
      return std::move(*there);
    }
  }
  auto part = compute();
  if (arguments.resumes && can_keep(part)) {
    app::Output output(kept);
    write_part_file(output, part.bytes());
  }
  return part;
}

/// What --verbose says of a rank that is done.
void explain_costs(const Post& post, app::Session& session);

}  // namespace ph::barcode
