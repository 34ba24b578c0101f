// SPDX-License-Identifier: MIT
#include "apps/barcode/complex/read_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include "ph/detail/core/files.hpp"
#include "ph/detail/io/further_files.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/detail/report/sha256.hpp"

namespace ph::barcode {
namespace {

/// For a mesh without values, a note on how its vertices and faces are used. Empty for other data.
std::string note_on_mesh(const ReadResult& read, const Job& job) {
  const auto* const mesh = std::get_if<Mesh>(&read.data);
  if (job.question.complex == ComplexKind::lower_star || mesh == nullptr || mesh->faces() == 0 ||
      !mesh->values.empty())
    return {};
  return fmt::format(
      "the vertices are points, and the {} faces are not used; --values FILE gives values of the "
      "vertices and filters the mesh",
      mesh->faces());
}

/// Turns the data into one row for each time. @throws Error (bad_data) if the data are not a table.
Points series_of(const std::string& name, ReadResult& read) {
  if (auto* const points = std::get_if<Points>(&read.data)) return std::move(*points);
  const auto* const image = std::get_if<Image>(&read.data);
  if (image == nullptr || image->extents.size() > 2)
    throw Error(ErrorKind::bad_data,
                fmt::format("{}: found {}, expected a time series for --delay: a table of numbers, "
                            "a row for each time",
                            mark_place(name), read.description));
  Points series(image->extents[0], image->extents.size() == 2 ? image->extents[1] : 1);
  for (std::size_t i = 0; i < image->values.size(); ++i) series.data()[i] = image->values[i];
  return series;
}

/// Replaces a time series by points. Each window of the series becomes a point.
void embed(const std::string& name, const Delay& delay, std::size_t dropped,
           const RunContext& context, ReadResult& read) {
  if (dropped > 0)
    throw Error(ErrorKind::bad_data,
                fmt::format("{}: found {} rows with NaN, expected numbers: no time may be missing "
                            "for --delay",
                            mark_place(name), dropped));
  const Points series = series_of(name, read);
  const auto [dimension, lag] = delay;
  // Each point consists of the numbers from `dimension` rows.
  context.memory.require(static_cast<std::size_t>(series.size()) * sizeof(double) *
                         static_cast<std::size_t>(std::min(dimension, series.rows())));
  Points points;
  try {
    points = delay_embedding(series, dimension, lag);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", mark_place(name), error.marked()));
  }
  read.description = fmt::format("time series of {} x {} values, {} windows as points in R^{}",
                                 series.rows(), series.cols(), points.rows(), points.cols());
  read.data = std::move(points);
}

/// The hash of all bytes that were read. A folder has no bytes of its own.
std::string hash_of(const Input& input, Format format, const RunContext& context) {
  report::Sha256 hash(context);
  hash.add(input);
  for (const auto& path : detail::further_files(input.path(), format))
    hash.add(Input::open_stored(path, &context, Input::Excess::is_expected));
  return hash.hex();
}

}  // namespace

Input open_input(const std::string& path, const Job& job, const RunContext& context,
                 Input::Excess excess, const Input::StartCheck& check) {
  return job.reading.options.stack ? Input::of_folder(files::path_of(path), &context)
                                   : Input::open(files::path_of(path), &context, excess, check);
}

NamedData read_input(const Input& input, const Job& job, const RunContext& context) {
  std::vector<Index> dropped;
  ReadOptions options = job.reading.options;
  options.context = &context;
  options.dropped = &dropped;
  Format format = job.reading.format;
  // A time series is either a table with one row for each time and any number of columns, or an
  // array, which may have one axis.
  if (job.reading.delay && format == Format::automatic && !detail::format_by_content(input))
    format = Format::points;
  ReadResult read = read_any(input, format, options, files::path_of(job.reading.values));
  if (job.reading.delay) embed(input.name(), *job.reading.delay, dropped.size(), context, read);
  if (std::string note = note_on_mesh(read, job); !note.empty())
    read.notes.push_back(std::move(note));
  std::string sha256;
  if (!job.places.report.empty() && !job.results.dry_run) sha256 = hash_of(input, format, context);
  return {input.name(), std::move(read), dropped.size(), std::move(sha256)};
}

}  // namespace ph::barcode
