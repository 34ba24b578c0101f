// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "apps/barcode/parts/part_files.hpp"
#include "apps/barcode/run.hpp"
#include "ph/detail/facade/post.hpp"
#include "ph/detail/facade/transport.hpp"

namespace ph::barcode {

/// The bars of all ranks, and their description in JSON.
struct RankBars {
  Barcode bars;
  BarcodeInfo info;
};

/// The result of a rank after all ranks are joined.
struct RankResult {
  /// The file in which --resume keeps the part of this rank; empty if the part is not kept.
  std::string kept;
  std::optional<RankBars> bars;  ///< present only on rank 0
};

/// Computes an image on all ranks. With --dry-run, prints what the ranks will need instead.
RankResult image_of_ranks(const Job& job, Transport& transport, app::Session& session);
/// Computes the components of a point cloud on all ranks, with some blocks on each rank.
/// @throws Error (usage) like read_cloud_input.
RankResult cloud_of_ranks(const Job& job, Transport& transport, app::Session& session);

/// The file in which --resume keeps the part of a rank.
std::string kept_path(const Job& job, int rank, int parts);

/// The part of this rank. With --resume, `find_kept` looks for the part in a file. If it finds no
/// part, `compute` makes the part. With --resume, the part is then written to the file.
/// @param find_kept returns an optional part. @param compute returns a part.
/// @param can_keep returns true if a file can replace a part.
template <class FindKept, class Compute, class CanKeep>
auto kept_or_computed(const std::string& kept, const Job& job, app::Session& session,
                      FindKept&& find_kept, Compute&& compute, CanKeep&& can_keep) {
  if (job.sharing.resumes) {
    if (auto there = find_kept(); there && can_keep(*there)) {
      session.explain(kept + " already exists");
      return std::move(*there);
    }
  }
  auto part = compute();
  if (job.sharing.resumes && can_keep(part)) {
    app::Output output(kept);
    write_part_file(output, part.bytes());
  }
  return part;
}

/// Prints the message of --verbose for a rank that has finished.
void explain_costs(const Post& post, app::Session& session);

/// Computes an image, or the components of points, on all ranks. Each rank calls this function with
/// the same job. Rank 0 writes the results.
/// @param wait_for_all returns once all ranks have called it.
/// @return the exit code of this rank. @throws Error.
int run_ranks(const Job& job, Transport& transport, const std::function<void()>& wait_for_all,
              app::Session& session);

}  // namespace ph::barcode
