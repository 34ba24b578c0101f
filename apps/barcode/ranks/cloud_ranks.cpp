// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <utility>

#include "apps/barcode/parts/cloud_input.hpp"
#include "apps/barcode/parts/cloud_parts.hpp"
#include "apps/barcode/ranks/rank_result.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/facade/join_ranks.hpp"

namespace ph::barcode {
RankResult cloud_of_ranks(const Job& job, Transport& transport, app::Session& session) {
  const RunContext& context = session.context();
  const CloudInput cloud = read_cloud_input(job.places.input, job, session);
  const int rank = transport.rank(), parts = transport.size();
  if (job.results.dry_run) {
    if (rank == 0) foresee(cloud, parts, "rank");
    return {};
  }
  RankResult result{kept_path(job, rank, parts), std::nullopt};
  Post post(transport);
  std::optional<CloudPart> own = kept_or_computed(
      result.kept, job, session,
      [&] { return kept_cloud_part(result.kept, cloud, rank, parts, session); },
      [&] { return CloudPart(cloud.points, rank, parts, cloud.options, context); },
      [](const CloudPart&) { return true; });
  std::optional<CloudPart> whole = join_ranks(std::move(own), post, context);
  explain_costs(post, session);
  if (!whole) return result;
  const std::string description =
      fmt::format("{}, {}", cloud.data.read.description,
                  app::count_of(static_cast<std::size_t>(parts), "rank"));
  const BarcodeInfo info = named(whole->info(), description, job);
  result.bars.emplace(RankBars{bars_of(std::move(*whole), job.places.format, context), info});
  return result;
}

}  // namespace ph::barcode
