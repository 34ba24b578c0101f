// SPDX-License-Identifier: MIT
#include "barcode/output/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <new>
#include <set>

#include "barcode/output/complex_arrays.hpp"
#include "barcode/output/h0_tree.hpp"
#include "barcode/output/stored.hpp"
#include "common/terminal/exit_code.hpp"
#include "ph/bottleneck.hpp"
#include "ph/detail/core/file_pages.hpp"
#include "report/arrays/bar_arrays.hpp"
#include "report/arrays/point_arrays.hpp"
#include "report/arrays/voxel_arrays.hpp"
#include "report/encoding/sha256.hpp"
#include "report/report_file.hpp"

namespace ph::barcode {
namespace {

using report::ReportFile;

constexpr Index kMostColumns = 3;  // of positions
// Up to here positions are written as they are: the page finds the edges of a complex by them.
constexpr Index kMostExactPoints = 50'000;
constexpr std::size_t kMostVoxels = std::size_t{1} << 24;  // in a page
// Bars of a dimension in both barcodes: their distance takes seconds at most.
constexpr std::size_t kMostComparedBars = 40'000;

/// The points that the page shows; null where there are none, or where cells are those of a grid.
const Points* points_of(const Shown& shown) {
  if (std::holds_alternative<Cubical>(shown.built.complex)) return nullptr;
  if (const auto* mesh = std::get_if<Mesh>(&shown.data.read.data)) return &mesh->vertices;
  const auto* points = std::get_if<Points>(&shown.data.read.data);
  return points && points->rows() > 0 && points->cols() > 0 ? points : nullptr;
}

/// The image that the page shows: of two or three axes, and not too large.
std::optional<CubicalImage> image_of(const Shown& shown) {
  const auto* cubical = std::get_if<Cubical>(&shown.built.complex);
  if (!cubical) return std::nullopt;
  CubicalImage image = cubical->cubical_image();
  const bool fits = image.extents.size() == 2 || image.extents.size() == 3;
  if (!fits || image.size() == 0 || image.size() > kMostVoxels) return std::nullopt;
  return image;
}

/// Whether the first axis of an image is x: its format says so, or it was made of points.
bool has_axes_of_space(const ReadResult& read) {
  return read.format == Format::nifti || read.format == Format::dipha ||
         std::holds_alternative<Points>(read.data);
}

/// Whether pairs within a distance are the edges: all points are vertices, all enter at once.
bool is_euclidean(const Shown& shown, const Arguments& arguments) {
  return std::holds_alternative<Rips>(shown.built.complex) && !shown.built.subsample &&
         arguments.rips.distance == PointDistance::euclidean && !arguments.rips.approximation &&
         arguments.rips.births.empty() && !arguments.dtm && arguments.vertex_weights.empty();
}

/// What the page cannot find out for itself.
ComplexArrays complex_of(const Shown& shown, const Arguments& arguments,
                         const RunContext& context) {
  const Points* points = points_of(shown);
  if (!points) return {};
  if (is_euclidean(shown, arguments) && points->cols() <= kMostColumns &&
      points->rows() <= kMostExactPoints)
    return {};
  return complex_arrays(shown.built.complex, static_cast<std::size_t>(points->rows()),
                        shown.data.read.point_ids, context);
}

report::CloudMeta cloud_meta(const Points& points, const Shown& shown, const Arguments& arguments) {
  report::CloudMeta meta;
  if (is_euclidean(shown, arguments)) meta.metric = "euclidean";
  if (points.cols() > kMostColumns)
    meta.projection = fmt::format("first {} of {} coordinates", kMostColumns, points.cols());
  return meta;
}

report::Metadata metadata_of(const Shown& shown, const Arguments& arguments,
                             const std::optional<CubicalImage>& image,
                             const std::optional<ShownTree>& tree) {
  const bool rips = std::holds_alternative<Rips>(shown.built.complex);
  report::Metadata meta;
  meta.title = report::title_of(shown.info.input);
  meta.value_label = rips ? "Distance" : image ? "Value" : "Filtration value";
  // Files of barcodes hold -f of superlevel sets; a reader of the page sees f.
  const auto* cubical = std::get_if<Cubical>(&shown.built.complex);
  meta.negated = cubical && cubical->cubical_image().superlevel;
  meta.barcodes.push_back({meta.title, shown.barcode.cell_kind(), shown.barcode.representatives()});
  if (const Points* points = points_of(shown)) meta.cloud = cloud_meta(*points, shown, arguments);
  if (image) {
    meta.construction = image->voxels_are_vertices ? "vertices" : "cells";
    if (has_axes_of_space(shown.data.read) && image->extents.size() == 3)
      meta.axes = {"x", "y", "z"};
  }
  if (tree) meta.tree = tree->meta;
  meta.provenance.command = arguments.command;
  meta.provenance.sha256 = shown.data.sha256;
  meta.provenance.run = shown.info;
  meta.provenance.warnings = shown.warnings;
  auto& notes = meta.provenance.notes;
  if (const auto& assumed = shown.data.read.notes; !assumed.empty())
    notes.emplace_back("Assumed", fmt::format("{}", fmt::join(assumed, "; ")));
  if (!shown.info.vertex_weights.empty())
    notes.emplace_back("Vertices enter late", shown.info.vertex_weights);
  if (shown.built.promise) notes.emplace_back("Approximation", *shown.built.promise);
  if (std::holds_alternative<Cubical>(shown.built.complex) && !image)
    notes.emplace_back("Image", "not shown: too large, or not of two or three axes");
  return meta;
}

void add_points(ReportFile& report, const Points& points, const std::vector<Index>& ids,
                std::span<const std::uint32_t> leaf_of) {
  const auto dims = static_cast<std::size_t>(std::min(points.cols(), kMostColumns));
  const auto count = static_cast<std::size_t>(points.rows());
  const double tolerance = points.rows() > kMostExactPoints ? kInfinity : 0;
  if (points.cols() <= kMostColumns) {
    report::add_positions(report, std::span(points.data(), count * dims), dims, tolerance);
  } else {
    const MemoryClaim copy(report.context().memory, count * dims * sizeof(double));
    const Points first(PointsView(points.data(), points.rows(), kMostColumns, points.cols(), 1));
    report::add_positions(report, std::span(first.data(), count * dims), dims, tolerance);
  }
  if (!ids.empty()) {
    std::vector<std::uint32_t> numbers;
    numbers.reserve(ids.size());
    for (const Index id : ids) numbers.push_back(static_cast<std::uint32_t>(id));
    report.add("points/index", numbers, {.delta = true});
  }
  if (leaf_of.size() == count) report::add_labels(report, "points/leaf", leaf_of, true);
}

void add_image(ReportFile& report, const CubicalImage& image,
               std::span<const std::uint32_t> leaf_of) {
  report.add_voxels("image/values", image);
  if (leaf_of.size() == image.size()) report::add_labels(report, "points/leaf", leaf_of, true);
}

/// The barcode is there already: it is worth showing without its tree.
std::optional<ShownTree> tree_if_it_fits(const Shown& shown, const Arguments& arguments,
                                         app::Session& session) {
  try {
    return h0_tree(shown, arguments, session.context());
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::resource) throw;
    session.note(fmt::format("--report: no merge tree: {}", error.what()));
  } catch (const std::bad_alloc&) {
    session.note("--report: no merge tree: out of memory");
  }
  return std::nullopt;
}

/// The distances of two barcodes, one a dimension that either has.
/// @param matched receives the numbers of the bars that they pair.
/// @return where they would take long: "H1: 50000 bars".
std::vector<std::string> add_distances(report::Metadata& meta, const Barcode& a, const Barcode& b,
                                       std::vector<std::uint32_t>& matched, app::Session& session) {
  std::set<int> dims;
  for (const Barcode* barcode : {&a, &b})
    for (const Bar& bar : *barcode) dims.insert(bar.dim);
  std::vector<std::string> left_out;
  for (const int dim : dims) {
    const std::span<const Bar> bars[] = {a.bars(dim), b.bars(dim)};
    const std::size_t count = bars[0].size() + bars[1].size();
    if (count > kMostComparedBars) {
      left_out.push_back(fmt::format("H{}: {} bars", dim, count));
      continue;
    }
    const auto [distance, pairs] = bottleneck_matching(bars[0], bars[1], session.context());
    meta.distances.push_back({dim, distance});
    // Numbers of bars: those of a dimension come one after another in each barcode.
    const auto first = bars[0].empty() ? 0U : static_cast<std::uint32_t>(&bars[0][0] - &a[0]);
    const auto second = bars[1].empty() ? 0U : static_cast<std::uint32_t>(&bars[1][0] - &b[0]);
    for (const auto& [i, j] : pairs)
      matched.insert(matched.end(), {first + i, static_cast<std::uint32_t>(a.size()) + second + j});
  }
  if (!left_out.empty())
    meta.provenance.notes.emplace_back(
        "Distances left out",
        fmt::format("{}; at most {} are compared", fmt::join(left_out, ", "), kMostComparedBars));
  return left_out;
}

}  // namespace

void write_report(OutputFile& file, const Shown& shown, const Arguments& arguments,
                  app::Session& session) {
  const std::optional<ShownTree> tree = tree_if_it_fits(shown, arguments, session);
  const std::optional<CubicalImage> image = image_of(shown);
  report::Metadata meta = metadata_of(shown, arguments, image, tree);
  const report::VoxelSets sets =
      image ? report::voxel_sets(shown.barcode, session.context()) : report::VoxelSets();
  const ComplexArrays cells_shown = complex_of(shown, arguments, session.context());
  if (meta.cloud) {
    meta.cloud->edges_below = cells_shown.missing_from;
    meta.cloud->triangles_below = cells_shown.triangles_missing_from;
  }
  if (const std::string note = sets.note(); !note.empty())
    meta.provenance.notes.emplace_back("Sets of voxels", note);
  ReportFile report(file, meta, session.context());
  report::add_pictures(report, std::span(&shown.barcode, 1), meta);
  // Doubled coordinates mean something on an image that is there only.
  const bool cells = shown.barcode.cell_kind() != CellKind::grid || image.has_value();
  report::add_bars(report, shown.barcode, "bars", cells);
  if (cells) report::add_chains(report, shown.barcode);
  report::add_voxel_sets(report, sets);
  std::span<const std::uint32_t> leaf_of;
  if (tree) {
    report::add_tree(report, tree->tree, tree->contracted, tree->bars, tree->meta.rule);
    leaf_of = tree->contracted.leaf_of;
  }
  if (image) add_image(report, *image, leaf_of);
  // The vertices of a listed complex come in the order of its list.
  if (std::holds_alternative<ExplicitComplex>(shown.built.complex)) leaf_of = {};
  if (const Points* points = points_of(shown))
    add_points(report, *points, shown.data.read.point_ids, leaf_of);
  add_complex(report, cells_shown);
  report.finish();
}

int run_comparison(const Arguments& arguments, app::Session& session) try {
  const DistanceFormat format = distance_format(arguments);
  std::optional<app::Output> distances, output;
  if (arguments.output_format != BarcodeFormat::none) distances.emplace(arguments.output);
  if (!arguments.report.empty()) output.emplace(arguments.report);
  const std::string &first = arguments.compare[0], &second = arguments.compare[1];
  report::Metadata meta;
  meta.title = fmt::format("{} and {}", report::title_of(first), report::title_of(second));
  meta.value_label = "Filtration value";
  meta.provenance.command = arguments.command;
  meta.provenance.has_homology = false;
  meta.provenance.run.program = app::program_and_version("ph-barcode");
  meta.provenance.run.input = fmt::format("{}, {}", first, second);
  std::vector<Barcode> barcodes;
  for (const std::string& path : arguments.compare) {
    const Input input = Input::open(path, &session.context());
    barcodes.push_back(read_barcode(input));
    meta.barcodes.push_back({report::title_of(path), barcodes.back().cell_kind()});
    meta.provenance.notes.emplace_back(
        fmt::format("SHA-256 of {}", barcodes.size() == 1 ? "the first" : "the second"),
        report::sha256_hex(input, session.context()));
    session.note(fmt::format("read {}: {} bars", input.name(), barcodes.back().size()));
  }
  std::vector<std::uint32_t> matched;
  const auto left_out = add_distances(meta, barcodes[0], barcodes[1], matched, session);
  for (const std::string& what : left_out)  // not each format has room for them
    session.note(fmt::format("left out: {}; at most {} are compared", what, kMostComparedBars));
  meta.provenance.run.peak_memory = app::peak_memory();
  const app::BarHold results_are_written(session);
  if (distances) {
    distances->write(distances_file(meta.distances, left_out, arguments, format));
    distances->commit();
  }
  if (!output) return app::kOk;
  ReportFile report(output->file(), meta, session.context());
  report::add_pictures(report, barcodes, meta);
  report::add_bars(report, barcodes[0], "bars", false);
  report::add_bars(report, barcodes[1], "bars2", false);
  report.add("matching/pairs", matched, {.shape = {matched.size() / 2, 2}, .delta = true});
  report.finish();
  output->commit();
  return app::kOk;
} catch (const Error& error) {
  if (error.kind() != ErrorKind::resource) throw;
  throw Error(ErrorKind::resource, fmt::format("{}; {}", error.what(), kFewerBars));
} catch (const std::bad_alloc&) {
  throw Error(ErrorKind::resource, fmt::format("out of memory; {}", kFewerBars));
}

}  // namespace ph::barcode
