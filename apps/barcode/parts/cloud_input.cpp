// SPDX-License-Identifier: MIT
#include "apps/barcode/parts/cloud_input.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "apps/barcode/parts/part_files.hpp"
#include "apps/common/inputs/read_data.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/detail/metric/metric.hpp"

namespace ph::barcode {

CloudInput read_cloud_input(const std::string& input, const Job& job, app::Session& session) {
  const std::string_view why = job.sharing.part ? "--part" : "several ranks";
  if (job.question.options.max_dim != 0)
    throw Error(
        ErrorKind::usage,
        fmt::format(
            "{} with --complex rips: expected --max-dim 0, because only components are computed",
            why));
  if (job.question.rips.distance != PointDistance::euclidean)
    throw Error(ErrorKind::usage, fmt::format("--metric: found {}, expected euclidean with {}",
                                              name_of(job.question.rips.distance), why));
  NamedData data =
      read_input(Input::open(files::path_of(input), &session.context(), Input::Excess::refused,
                             detail::start_check(job.reading.format)),
                 job, session.context());
  const std::string& description = data.read.description;
  const std::optional<PointsView> points = app::points_of(data.read);
  if (!points)
    throw Error(ErrorKind::usage, fmt::format("{}: found {}, expected points", why, description));
  session.explain(fmt::format("read {}: {}", data.name, description));
  for (const Message& note : data.read.notes)
    session.note(fmt::format("{}: {}", data.name, note.marked()));
  CloudInput cloud{std::move(data), {}, {.threshold = job.question.threshold}};
  cloud.points = *app::points_of(cloud.data.read);
  return cloud;
}

std::optional<CloudPart> kept_cloud_part(const std::string& path, const CloudInput& cloud, int part,
                                         int parts, app::Session& session) {
  return kept_part(
      path, session,
      [&](std::span<const std::byte> bytes) {
        return CloudPart::of_bytes(bytes, session.context());
      },
      [&](const CloudPart& kept) {
        return kept.is_of(cloud.points, part, parts, cloud.options)
                   ? ""
                   : "is not the requested part for this input and these options";
      });
}

}  // namespace ph::barcode
