// SPDX-License-Identifier: MIT
#include "ph/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "libreport/report/arrays/complex_arrays.hpp"
#include "libreport/report/arrays/point_arrays.hpp"
#include "libreport/report/arrays/tree_arrays.hpp"
#include "libreport/report/arrays/voxel_arrays.hpp"
#include "ph/detail/core/file_pages.hpp"
#include "ph/detail/report/bar_arrays.hpp"
#include "ph/detail/report/report_file.hpp"

namespace ph::report {
namespace {

constexpr Index kMostColumns = 3;  // the most columns of positions
// Up to this number of points, positions are written exactly, because the page derives the edges of
// a complex from them.
constexpr Index kMostExactPoints = 50'000;
// The most voxels in a page.
constexpr std::size_t kMostVoxels = std::size_t{1} << 24;

template <class Complex>
const Complex* complex_as(const BarcodePage& page) {
  return page.complex ? std::get_if<Complex>(page.complex) : nullptr;
}

/// The image that the page shows. Empty unless the input is an image that has two or three axes and
/// is not too large.
std::optional<CubicalImage> image_of(const BarcodePage& page) {
  const auto* cubical = complex_as<Cubical>(page);
  if (!cubical) return std::nullopt;
  CubicalImage image = cubical->cubical_image();
  const bool fits = image.extents.size() == 2 || image.extents.size() == 3;
  if (!fits || image.size() == 0 || image.size() > kMostVoxels) return std::nullopt;
  return image;
}

/// The data that the page cannot derive itself.
ComplexArrays complex_of(const BarcodePage& page, const RunContext& context) {
  if (!page.points) return {};
  const PointsView& points = *page.points;
  if (page.is_euclidean && points.cols() <= kMostColumns && points.rows() <= kMostExactPoints)
    return {};
  return complex_arrays(*page.complex, page.form, static_cast<std::size_t>(points.rows()),
                        page.point_ids, context);
}

CloudMeta cloud_meta(const BarcodePage& page) {
  CloudMeta meta;
  if (page.is_euclidean) meta.metric = "euclidean";
  if (page.points->cols() > kMostColumns)
    meta.projection = fmt::format("first {} of {} coordinates", kMostColumns, page.points->cols());
  return meta;
}

Metadata metadata_of(const BarcodePage& page, const std::optional<CubicalImage>& image) {
  Metadata meta;
  meta.title = page.title;
  // For superlevel sets of f, barcode files contain the values of -f, but the page shows the values
  // of f.
  const auto* cubical = complex_as<Cubical>(page);
  meta.negated = cubical ? cubical->cubical_image().superlevel : page.negated;
  const bool of_values = page.complex ? image.has_value() : meta.negated;
  meta.value_label = complex_as<Rips>(page) ? "Distance" : of_values ? "Value" : "Filtration value";
  if (const auto* alpha = complex_as<Alpha>(page))
    meta.value_label = alpha->unit() == AlphaOptions::Unit::radius ? "Radius" : "Squared radius";
  meta.barcodes.push_back({meta.title, page.barcode.cell_kind(), page.barcode.representatives()});
  if (page.points) meta.cloud = cloud_meta(page);
  if (image) {
    meta.construction = image->voxels_are_vertices ? "vertices" : "cells";
    if (page.has_axes_of_space && image->extents.size() == 3) meta.axes = {"x", "y", "z"};
  }
  if (page.tree) meta.tree = page.tree->meta;
  meta.provenance = page.provenance;
  if (cubical && !image)
    meta.provenance.notes.emplace_back(
        "Image", "not shown: too large, or it has neither two nor three axes");
  return meta;
}

void add_points(ReportFile& report, const PointsView& points, std::span<const Index> ids,
                std::span<const std::uint32_t> leaf_of) {
  const Index columns = std::min(points.cols(), kMostColumns);
  const auto dims = static_cast<std::size_t>(columns);
  const auto count = static_cast<std::size_t>(points.rows());
  const double tolerance = points.rows() > kMostExactPoints ? kInfinity : 0;
  const bool side_by_side = points.cols() == columns && points.has_whole_rows() &&
                            (count == 1 || points.row(1) - points.row(0) == columns);
  if (side_by_side) {
    add_positions(report, std::span(points.row(0), count * dims), dims, tolerance);
  } else {
    const MemoryClaim copy(report.context().memory, count * dims * sizeof(double));
    std::vector<double> first;
    first.reserve(count * dims);
    for (Index i = 0; i < points.rows(); ++i)
      for (Index k = 0; k < columns; ++k) first.push_back(points(i, k));
    add_positions(report, std::span<const double>(first), dims, tolerance);
  }
  if (!ids.empty()) {
    std::vector<std::uint32_t> numbers;
    numbers.reserve(ids.size());
    for (const Index id : ids) numbers.push_back(static_cast<std::uint32_t>(id));
    report.add("points/index", numbers, {.delta = true});
  }
  if (leaf_of.size() == count) add_labels(report, "points/leaf", leaf_of, true);
}

void add_image(ReportFile& report, const CubicalImage& image,
               std::span<const std::uint32_t> leaf_of) {
  report.add_voxels("image/values", image);
  if (leaf_of.size() == image.size()) add_labels(report, "points/leaf", leaf_of, true);
}

}  // namespace

void write_page(const Sink& sink, const BarcodePage& page, const RunContext& context) {
  const std::optional<CubicalImage> image = image_of(page);
  Metadata meta = metadata_of(page, image);
  const VoxelSets sets = image ? voxel_sets(page.barcode, context) : VoxelSets();
  const ComplexArrays cells_shown = complex_of(page, context);
  if (meta.cloud) {
    meta.cloud->edges_below = cells_shown.missing_from;
    meta.cloud->triangles_below = cells_shown.triangles_missing_from;
  }
  if (const std::string note = sets.note(); !note.empty())
    meta.provenance.notes.emplace_back("Sets of voxels", note);
  ReportFile report(sink, meta, context);
  add_pictures(report, std::span(&page.barcode, 1), meta);
  // The doubled coordinates of grid cells have a meaning only if the page has the image.
  const bool cells =
      page.complex && (page.barcode.cell_kind() != CellKind::grid || image.has_value());
  add_bars(report, page.barcode, "bars", cells);
  if (cells) add_chains(report, page.barcode);
  add_voxel_sets(report, sets);
  std::span<const std::uint32_t> leaf_of;
  if (page.tree) {
    const ShownTree& shown = *page.tree;
    add_tree(report, shown.tree, shown.contracted, shown.bars, shown.meta.rule);
    leaf_of = shown.contracted.leaf_of;
  }
  if (image) add_image(report, *image, leaf_of);
  // Leaves are indexed by the order in which the complex lists its vertices. This is not the order
  // of the points.
  if (complex_as<ExplicitComplex>(page)) leaf_of = {};
  if (page.points) add_points(report, *page.points, page.point_ids, leaf_of);
  add_complex(report, cells_shown);
  report.finish();
}

}  // namespace ph::report
