// SPDX-License-Identifier: MIT
#include "apps/barcode/output/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <new>
#include <optional>
#include <utility>

#include "apps/barcode/output/stored.hpp"
#include "apps/common/distances/distance_choice.hpp"
#include "apps/common/inputs/barcode_files.hpp"
#include "apps/common/inputs/read_data.hpp"
#include "apps/common/system/process.hpp"
#include "apps/common/terminal/build_information.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/terminal/words.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/report/bar_arrays.hpp"
#include "ph/detail/report/report_file.hpp"
#include "ph/detail/report/sha256.hpp"
#include "ph/report.hpp"

namespace ph::barcode {
namespace {

using report::ReportFile;

// The largest number of bars of one dimension, in both barcodes together, for which computing their
// distance takes only seconds.
constexpr std::size_t kMostComparedBars = 40'000;

/// The points that the page shows. Empty if there are no points, or if cells are named by grid
/// coordinates.
std::optional<PointsView> shown_points(const Shown& shown) {
  if (std::holds_alternative<Cubical>(shown.built.complex)) return std::nullopt;
  const auto points = app::points_of(shown.data.read);
  if (!points || points->rows() == 0 || points->cols() == 0) return std::nullopt;
  return points;
}

/// True if the first axis of an image is x, because its format says so or because the image was
/// made from points.
bool has_axes_of_space(const ReadResult& read) {
  return read.format == Format::nifti || read.format == Format::nrrd ||
         read.format == Format::metaimage || read.format == Format::vti ||
         read.format == Format::dipha || std::holds_alternative<Points>(read.data);
}

/// True if the edges up to a value are exactly the pairs of points within this distance, because
/// all points are vertices and enter together.
bool is_euclidean(const Shown& shown, const Job& job) {
  return std::holds_alternative<Rips>(shown.built.complex) && !shown.built.subsample &&
         job.question.rips.distance == PointDistance::euclidean &&
         !job.question.rips.approximation && !job.question.rips.computes_births() &&
         job.question.vertex_weights.empty();
}

report::Provenance provenance_of(const Shown& shown, const Job& job) {
  report::Provenance provenance;
  provenance.command = job.command;
  provenance.sha256 = shown.data.sha256;
  provenance.run = shown.barcode.info();
  provenance.warnings = shown.warnings;
  auto& notes = provenance.notes;
  std::vector<std::string> assumed;
  for (const Message& note : shown.data.read.notes) assumed.push_back(note.in_words(app::kWords));
  if (!assumed.empty()) notes.emplace_back("Assumed", fmt::format("{}", fmt::join(assumed, "; ")));
  if (!shown.barcode.info().vertex_weights.empty())
    notes.emplace_back("Vertices enter late", shown.barcode.info().vertex_weights);
  if (const auto hidden = hidden_points(shown.built)) notes.emplace_back("Hidden", *hidden);
  if (shown.promise)
    notes.emplace_back("Approximation", fmt::format("{}: {}", shown.data.name, *shown.promise));
  return provenance;
}

/// The merge tree. Empty if memory does not suffice for it, because the complete barcode can also
/// be shown without the tree.
std::optional<report::ShownTree> tree_if_it_fits(const Shown& shown, app::Session& session) {
  const RunContext& context = session.context();
  try {
    std::optional<MergeTree> tree = tree_of(shown.built, context);
    if (!tree) return std::nullopt;
    return report::shown_tree(std::move(*tree), shown.barcode, shown.built.complex, context);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::resource) throw;
    session.note(fmt::format("--report: no merge tree: {}", error.marked()));
  } catch (const std::bad_alloc&) {
    session.note("--report: no merge tree: out of memory");
  }
  return std::nullopt;
}

/// Adds the distances between two barcodes, one for each dimension in which either barcode has
/// bars.
/// @param matched receives the numbers of the bars that are paired.
/// @return the dimensions that would take a long time, such as "H1: 50000 bars".
std::vector<std::string> add_distances(report::Metadata& meta, std::span<const Barcode, 2> barcodes,
                                       std::vector<std::uint32_t>& matched, app::Session& session) {
  const Barcode &a = barcodes[0], &b = barcodes[1];
  std::vector<std::string> left_out;
  for (const int dim : app::dims_of(barcodes)) {
    const std::span<const Bar> bars[] = {a.bars(dim), b.bars(dim)};
    const std::size_t count = bars[0].size() + bars[1].size();
    if (count > kMostComparedBars) {
      left_out.push_back(fmt::format("H{}: {} bars", dim, count));
      continue;
    }
    const auto [distance, pairs] = app::matching_of(bars[0], bars[1], {}, session.context());
    meta.distances.push_back({dim, distance.value});
    // The bars of one dimension are consecutive in each barcode, so the number of the first bar is
    // enough.
    const auto first = bars[0].empty() ? 0U : static_cast<std::uint32_t>(&bars[0][0] - &a[0]);
    const auto second = bars[1].empty() ? 0U : static_cast<std::uint32_t>(&bars[1][0] - &b[0]);
    for (const auto& [i, j] : pairs)
      if (i >= 0 && j >= 0)
        matched.insert(matched.end(), {first + static_cast<std::uint32_t>(i),
                                       static_cast<std::uint32_t>(a.size()) + second +
                                           static_cast<std::uint32_t>(j)});
  }
  if (!left_out.empty())
    meta.provenance.notes.emplace_back(
        "Distances left out",
        fmt::format("{}; at most {} are compared", fmt::join(left_out, ", "), kMostComparedBars));
  return left_out;
}

}  // namespace

void write_report(OutputFile& file, const Shown& shown, const Job& job, app::Session& session) {
  const auto tree = tree_if_it_fits(shown, session);
  report::BarcodePage page{report::title_of(shown.barcode.info().input), shown.barcode,
                           &shown.built.complex};
  page.form = shown.form;
  page.points = shown_points(shown);
  page.point_ids = shown.data.read.point_ids;
  page.is_euclidean = is_euclidean(shown, job);
  page.has_axes_of_space = has_axes_of_space(shown.data.read);
  page.tree = tree ? &*tree : nullptr;
  page.provenance = provenance_of(shown, job);
  report::write_page([&file](std::string_view text) { file.write(text); }, page, session.context());
}

int run_comparison(const Job& job, app::Session& session) try {
  const DistanceFormat format = distance_format(job);
  std::optional<app::Output> distances, output;
  if (job.results.output_format != BarcodeFormat::none) distances.emplace(job.places.output);
  if (!job.places.report.empty()) output.emplace(job.places.report);
  const std::string &first = job.compare[0], &second = job.compare[1];
  report::Metadata meta;
  meta.title = fmt::format("{} and {}", report::title_of(first), report::title_of(second));
  meta.value_label = "Filtration value";
  meta.provenance.command = job.command;
  meta.provenance.has_homology = false;
  meta.provenance.run.program = app::program_and_version("ph-barcode");
  meta.provenance.run.input = fmt::format("{}, {}", first, second);
  std::vector<Barcode> barcodes;
  app::SameOrigin origin(session);
  for (const std::string& path : job.compare) {
    const Input input = Input::open(files::path_of(path), &session.context(),
                                    Input::Excess::refused, barcode_start_check());
    StoredBarcode stored = read_stored_barcode(input);
    origin.add(path, stored.bars.info());
    barcodes.push_back(std::move(stored.bars));
    meta.barcodes.push_back({report::title_of(path), barcodes.back().cell_kind()});
    meta.provenance.notes.emplace_back(
        fmt::format("SHA-256 of {}", barcodes.size() == 1 ? "the first" : "the second"),
        report::sha256_hex(input, session.context()));
    session.note(fmt::format("read {}: {} bars", input.name(), barcodes.back().size()));
  }
  std::vector<std::uint32_t> matched;
  const auto left_out = add_distances(meta, std::span(barcodes).first<2>(), matched, session);
  // The dimensions left out are also noted here, because not all formats have room for them.
  for (const std::string& what : left_out)
    session.note(fmt::format("left out: {}; at most {} are compared", what, kMostComparedBars));
  meta.provenance.run.peak_memory = app::peak_memory();
  const app::BarHold results_are_written(session);
  if (distances) {
    distances->write(distances_file(meta.distances, barcodes, left_out, job, format));
    distances->commit();
  }
  if (!output) return app::kOk;
  const report::Sink sink = [&](std::string_view text) { output->file().write(text); };
  ReportFile report(sink, meta, session.context());
  report::add_pictures(report, barcodes, meta);
  report::add_bars(report, barcodes[0], "bars", false);
  report::add_bars(report, barcodes[1], "bars2", false);
  report.add("matching/pairs", matched, {.shape = {matched.size() / 2, 2}, .delta = true});
  report.finish();
  output->commit();
  return app::kOk;
} catch (const Error& error) {
  if (error.kind() != ErrorKind::resource) throw;
  throw Error(ErrorKind::resource, fmt::format("{}; {}", error.marked(), fewer_bars()));
} catch (const std::bad_alloc&) {
  throw Error(ErrorKind::resource, fmt::format("out of memory; {}", fewer_bars()));
}

}  // namespace ph::barcode
