// SPDX-License-Identifier: MIT
#include "apps/barcode/complex/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/barcode/arguments/scopes.hpp"
#include "apps/common/inputs/read_data.hpp"
#include "apps/common/terminal/messages.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/files.hpp"

namespace ph::barcode {
namespace {

bool is_given(const Job& job, std::string_view option) {
  return std::ranges::count(job.given, option, &app::GivenOption::name) > 0;
}

/// The reason why data of this kind cannot contain NaN. Empty if they can contain NaN.
std::string_view why_no_nan(const ReadResult& read) {
  if (read.format == Format::perseus) return "a Perseus file has none";
  if (std::holds_alternative<Mesh>(read.data)) return "a mesh has none";
  const auto* image = std::get_if<Image>(&read.data);
  if (!image) return {};
  const VoxelType type = image->values.type();
  return type == VoxelType::float32 || type == VoxelType::float64 ? "" : "no whole number is NaN";
}

/// True if every row may be the dimension, birth and death of a bar, although the file does not
/// state that it contains a barcode.
bool may_be_bars(const ReadResult& read) {
  constexpr double most = 9;  // the highest dimension that a bar may plausibly have
  const auto is_bar = [](double dim, double birth, double death) {
    return dim >= 0 && dim <= most && dim == std::floor(dim) && birth < death;
  };
  if (const auto* points = std::get_if<Points>(&read.data)) {
    if (points->cols() != 3 || points->rows() == 0) return false;
    for (Index i = 0; i < points->rows(); ++i)
      if (!is_bar((*points)(i, 0), (*points)(i, 1), (*points)(i, 2))) return false;
    return true;
  }
  const auto* image = std::get_if<Image>(&read.data);
  const bool is_table = image && read.format == Format::npy && image->extents.size() == 2 &&
                        image->extents[0] > 0 && image->extents[1] == 3;
  if (!is_table) return false;
  for (std::size_t k = 0; k < image->values.size(); k += 3)
    if (!is_bar(image->values[k], image->values[k + 1], image->values[k + 2])) return false;
  return true;
}

/// The number of points between which distances are given. Empty for other data.
std::optional<Index> number_of_points(const ReadResult& read) {
  if (const auto* dense = std::get_if<DistanceMatrix>(&read.data)) return dense->size();
  if (const auto* sparse = std::get_if<SparseDistances>(&read.data)) return sparse->size();
  return std::nullopt;
}

/// Throws the error for data that could not be read, with a hint if they can be read as bars.
[[noreturn]] void fail_to_read(const Job& job, const Error& error, Format format,
                               const RunContext& context) {
  bool has_bars = false;
  // A pipe cannot be read again.
  const bool is_guessed = error.kind() == ErrorKind::bad_data && format == Format::automatic;
  std::error_code ignored;
  if (is_guessed && std::filesystem::is_regular_file(files::path_of(job.places.input), ignored)) {
    try {
      has_bars =
          read_stored_barcode(Input::open(files::path_of(job.places.input), &context)).bars.size() >
          0;
      // The file cannot be read as a barcode either.
    } catch (const std::exception&) {
    }
  }
  if (!has_bars) throw;
  throw Error(error.kind(), fmt::format("{}; is it a barcode? ph-barcode plot {} -o FILE.svg draws "
                                        "it",
                                        error.marked(), printable(job.places.input)));
}

}  // namespace

Loaded load(const Job& job, std::optional<Input>& input, app::Session& session, Stopwatch& watch) {
  NamedData data = [&] {
    try {
      return read_input(*input, job, session.context());
    } catch (const Error& error) {
      fail_to_read(job, error, job.reading.format, session.context());
    }
  }();
  input.reset();
  const auto& [name, read, dropped, sha256] = data;
  if (is_given(job, "nan") && job.reading.options.nan == NanPolicy::error)
    app::require_no_dropped_points(name, dropped);
  const std::string what = fmt::format("read {}: {}", name, read.description);
  // In a batch, the line about each input states the format.
  if (job.reading.format == Format::automatic && job.inputs == std::vector{job.places.input})
    session.note(what);
  else
    session.explain(what);
  for (const Message& note : read.notes) session.note(fmt::format("{}: {}", name, note.marked()));
  if (job.reading.format == Format::automatic && job.reading.options.columns.empty() &&
      may_be_bars(read))
    session.note(
        fmt::format("{}: its rows may be dimension, birth and death; ph-barcode plot {} "
                    "-o FILE.svg draws them as bars",
                    name, printable(job.places.input)));
  watch.lap("read");
  auto claim = std::make_unique<MemoryClaim>(session.context().memory, app::bytes_of(read));
  std::string description = read.description;
  std::vector<Index> point_ids = read.point_ids;
  const std::optional<PointsView> view = app::points_of(read);
  const auto points = view ? std::optional(view->rows()) : number_of_points(read);
  const auto affine = read.affine;
  const bool drops_nan =
      dropped > 0 || (is_given(job, "nan") && job.reading.options.nan == NanPolicy::drop);
  const auto coordinates = view ? std::optional(view->cols()) : std::nullopt;
  if (const std::string_view why = why_no_nan(read); is_given(job, "nan") && !why.empty())
    session.note(fmt::format("{}: --nan does nothing: {}", name, why));
  const bool is_shown =
      (!job.places.report.empty() || !job.places.surfaces.empty() || job.writes_centroids()) &&
      !job.results.dry_run;
  BuiltComplex built =
      is_shown ? build_complex(read, name, dropped, job, session.context())
               : build_complex(std::move(data.read), name, dropped, job, session.context());
  if (job.reading.options.allow_empty && !built.empty)
    session.explain("--allow-empty: not needed, because the input is not empty");
  const auto* const cubical = std::get_if<Cubical>(&built.complex);
  if (cubical && cubical->cubical_image().extents.size() == 1 && is_given(job, "construction") &&
      job.question.options.representatives == Representatives::none)
    session.note("--construction does nothing: with one axis, both have the same bars");
  if (const auto hidden = hidden_points(built)) session.note(fmt::format("{}: {}", name, *hidden));
  if (built.empty && !job.reading.options.allow_empty)
    throw Error(ErrorKind::bad_data,
                fmt::format("{}: no points; --allow-empty accepts that", mark_place(name)));
  const bool refers_to_data = std::holds_alternative<Rips>(built.complex);
  Loaded loaded{
      std::move(built), name,     std::move(description), std::move(point_ids), points, coordinates,
      affine,           drops_nan};
  if (is_shown || refers_to_data) {
    loaded.data = std::move(data);
    loaded.claim = std::move(claim);
  }
  return loaded;
}

}  // namespace ph::barcode
