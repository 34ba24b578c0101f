// SPDX-License-Identifier: MIT
#include "barcode/ranks/cloud_ranks.hpp"

#include <fmt/format.h>

#include <utility>

#include "barcode/parts/cloud_input.hpp"
#include "barcode/parts/cloud_parts.hpp"
#include "common/arguments/numbers.hpp"
#include "facade/parts/join_ranks.hpp"

namespace ph::barcode {
namespace {

/// The part of this rank: computed, or with --resume taken from its file. Else with --resume it is
/// written there.
CloudPart own_blocks(const CloudInput& cloud, int rank, int parts, const std::string& kept,
                     const Arguments& arguments, app::Session& session) {
  if (arguments.resumes) {
    auto there = kept_cloud_part(kept, arguments.inputs.front(), cloud, rank, parts, session);
    if (there) {
      session.explain(fmt::format("rank {}: {} is there already", rank, kept));
      return std::move(*there);
    }
  }
  CloudPart part(cloud.points, rank, parts, cloud.options, session.context());
  if (arguments.resumes) {
    app::Output output(kept);
    write_part_file(output, part.bytes());
  }
  return part;
}

}  // namespace

RankResult cloud_of_ranks(const Job& job, const Arguments& arguments, Transport& transport,
                          app::Session& session) {
  const RunContext& context = session.context();
  const CloudInput cloud = read_cloud_input(job.input, arguments, session);
  const int rank = transport.rank(), parts = transport.size();
  if (arguments.dry_run) {
    if (rank == 0) foresee(cloud, parts, true);
    return {};
  }
  RankResult result{kept_path(arguments, rank, parts), std::nullopt};
  Post post(transport);
  std::optional<CloudPart> whole =
      join_ranks(std::optional(own_blocks(cloud, rank, parts, result.kept, arguments, session)),
                 post, context);
  explain_costs(post, session);
  if (!whole) return result;
  const std::string description =
      fmt::format("{}, {}", cloud.data.read.description,
                  app::count_of(static_cast<std::size_t>(parts), transport.word()));
  const BarcodeInfo info = info_of(*whole, description, job.input);
  result.bars.emplace(RankBars{bars_of(std::move(*whole), job.format, context), info});
  return result;
}

}  // namespace ph::barcode
