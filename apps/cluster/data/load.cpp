// SPDX-License-Identifier: MIT
#include "apps/cluster/data/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <variant>
#include <vector>

#include "apps/cluster/arguments/scopes.hpp"
#include "apps/common/inputs/read_data.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/write.hpp"

namespace ph::cluster {
namespace {

Input open(const Arguments& a, app::Session& session) {
  std::optional<app::BarHold> somebody_types;
  if (app::is_typed({a.input()})) somebody_types.emplace(session);
  Input input = Input::open(files::path_of(a.input()), &session.context(),
                            Input::Excess::stays_in_file, detail::start_check(a.format));
  if (a.format == Format::automatic && a.reading.columns.empty() && is_barcode(input))
    throw Error(ErrorKind::bad_data,
                fmt::format("{}: found a barcode, expected points or distances; --format points "
                            "reads its bars as points",
                            mark_place(input.name())));
  return input;
}

/// The kind of the data. @throws Error (bad_data) if they are neither points nor distances.
Situation kind_of(const std::string& name, const ReadResult& read) {
  if (app::points_of(read)) return kPoints;
  if (std::holds_alternative<SparseDistances>(read.data)) return kSomePairs;
  if (!std::holds_alternative<DistanceMatrix>(read.data))
    throw Error(ErrorKind::bad_data, fmt::format("{}: found {}, expected points or distances",
                                                 mark_place(name), read.description));
  constexpr std::array kHalves{Format::lower_distance, Format::upper_distance, Format::binary};
  return std::ranges::find(kHalves, read.format) == kHalves.end() ? kMatrix : kTriangle;
}

Index size_of(const ReadResult& read) {
  if (const auto points = app::points_of(read)) return points->rows();
  if (const auto* some = std::get_if<SparseDistances>(&read.data)) return some->size();
  return std::get<DistanceMatrix>(read.data).size();
}

/// The cloud with all its fields. @throws Error (usage) if the input is not a cloud.
Cloud read_whole_cloud(const Input& input, const ReadResult& read, const Arguments& a,
                       const RunContext& context) {
  constexpr std::array kClouds{Format::pcd, Format::ply, Format::xyz, Format::pts};
  if (std::ranges::find(kClouds, read.format) == kClouds.end())
    throw Error(ErrorKind::usage,
                fmt::format("--output: found the format {} for {}, expected csv, json or npy, "
                            "because only a cloud (PCD, PLY, XYZ, PTS) has fields",
                            name_of(a.written_format()), read.description));
  const ReadOptions options{.allow_empty = true, .context = &context};
  if (read.format == Format::pcd) return read_pcd(input, options);
  if (read.format == Format::ply) return read_ply(input, options);
  return read.format == Format::xyz ? read_xyz(input, options) : read_pts(input, options);
}

bool is_given(const Arguments& a, std::string_view option) {
  return std::ranges::count(a.given, option, &app::GivenOption::name) > 0;
}

}  // namespace

Loaded load(const Arguments& a, app::Session& session) {
  const RunContext& context = session.context();
  const Input input = open(a, session);
  std::vector<Index> dropped;
  ReadOptions options = a.reading;
  options.context = &context;
  options.dropped = &dropped;
  Loaded loaded{input.name(), read_any(input, a.format, options)};
  const ReadResult& read = loaded.read;
  const Situation kind = kind_of(loaded.name, read);
  app::require_in_scope(a.given, kind, name_of(kind));
  if (is_given(a, "nan") && a.reading.nan == NanPolicy::error)
    app::require_no_dropped_points(loaded.name, dropped.size());
  loaded.points = size_of(read);
  // mutant: cluster-rows
  loaded.rows = loaded.points + static_cast<Index>(dropped.size());
  if (loaded.points == 0 && !a.reading.allow_empty)
    throw Error(ErrorKind::bad_data,
                fmt::format("{}: no points; --allow-empty accepts that", mark_place(loaded.name)));
  const std::string what = fmt::format("read {}: {}", loaded.name, read.description);
  if (a.format == Format::automatic)
    session.note(what);
  else
    session.explain(what);
  for (const Message& note : read.notes)
    session.note(fmt::format("{}: {}", loaded.name, note.marked()));
  if (const auto* mesh = std::get_if<Mesh>(&read.data); mesh != nullptr && mesh->faces() > 0)
    session.note(fmt::format("{}: the vertices are points, and the {} faces are not used",
                             loaded.name, mesh->faces()));
  if (is_given(a, "nan") && std::holds_alternative<Mesh>(read.data))
    session.note(fmt::format("{}: --nan does nothing: a mesh has none", loaded.name));
  if (a.reading.allow_empty && loaded.points > 0)
    session.explain("--allow-empty: not needed, because the input is not empty");
  if (a.writes_cloud() && !a.dry_run) {
    loaded.cloud = read_whole_cloud(input, read, a, context);
    const auto& [x, y, z, qw, qx, qy, qz] = loaded.cloud->viewpoint;
    if (a.written_format() == OutputFormat::ply && (x != 0 || y != 0 || z != 0))
      session.note(fmt::format("{}: PLY does not hold the viewpoint {},{},{}", printable(a.output),
                               x, y, z));
  }
  const std::size_t bytes =
      app::bytes_of(read) + (loaded.cloud ? loaded.cloud->data.size() : std::size_t{0});
  loaded.claim = std::make_unique<MemoryClaim>(context.memory, bytes);
  return loaded;
}

}  // namespace ph::cluster
