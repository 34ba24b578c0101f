// SPDX-License-Identifier: MIT
#include "ph/detail/io/barcode_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ph {

std::string shortest(double value) {
  return fmt::format("{}", value == 0 ? 0.0 : value);  // the number -0.0 becomes 0
}

namespace {

/// Formats a number as in Ripser's output, with six significant digits. The number -0 becomes 0.
std::string six_digits(double value) { return fmt::format("{:g}", value == 0 ? 0.0 : value); }

}  // namespace

namespace {

using Place = std::vector<double>;

/// An unknown place leaves its cells empty.
std::string cells(const Place& place, std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k)
    text += place.empty() ? "," : fmt::format(",{}", shortest(place[k]));
  return text;
}

/// The columns that say where the holes of an image are. The same columns come first in a table
/// that Python makes (python/libph/_barcodes/_places.py).
class PlaceColumns {
 public:
  PlaceColumns(const Barcode& bars, const BarcodeInfo& info) : bars_(bars), info_(info) {}

  std::string header() const {
    std::string text;
    for (const char* end : {"birth", "death", "centroid"})
      for (std::size_t axis = 0; axis < axes(); ++axis) text += fmt::format(",{}_{}", end, axis);
    text += ",voxels";
    if (!info_.affine) return text;
    for (const char* end : {"birth", "death", "centroid"})
      for (const char name : {'x', 'y', 'z'}) text += fmt::format(",{}_{}", end, name);
    return text + (axes() == 3 ? ",volume" : "");
  }
  std::string row(std::size_t i) const {
    const std::span<const std::uint32_t> voxels = bars_.voxels(i);
    const std::array places{place_of(bars_.birth_voxel(i)), place_of(bars_.death_voxel(i)),
                            voxels.empty() ? middle_of_cycle(i) : middle_of(voxels)};
    std::string text;
    for (const Place& place : places) text += cells(place, axes());
    text += fmt::format(",{}", voxels.size());
    if (!info_.affine) return text;
    for (const Place& place : places) text += cells(in_space(place), 3);
    if (axes() == 3)
      text += fmt::format(",{}",
                          shortest(static_cast<double>(voxels.size()) * std::abs(determinant())));
    return text;
  }

 private:
  std::size_t axes() const { return info_.shape.size(); }
  static Place place_of(std::span<const Index> voxel) { return {voxel.begin(), voxel.end()}; }
  Place middle_of(std::span<const std::uint32_t> voxels) const {
    Place sum(axes());
    for (std::uint64_t voxel : voxels)
      for (std::size_t axis = axes(); axis-- > 0;) {
        const auto extent = static_cast<std::uint64_t>(info_.shape[axis]);
        sum[axis] += static_cast<double>(voxel % extent);
        voxel /= extent;
      }
    for (double& x : sum) x /= static_cast<double>(voxels.size());
    return sum;
  }
  /// The mean of the cells. The voxel (i, j) is the cell (2 i, 2 j), or (2 i + 1, 2 j + 1).
  Place middle_of_cycle(std::size_t i) const {
    const InputChain cycle = bars_.representative(i);
    if (cycle.size() == 0) return {};
    Place sum(axes());
    for (std::size_t k = 0; k < cycle.size(); ++k)
      for (std::size_t axis = 0; axis < axes(); ++axis)
        sum[axis] += static_cast<double>(cycle.cell(k).numbers[axis]);
    const double shift = info_.construction == "cells" ? 1 : 0;
    for (double& x : sum) x = (x / static_cast<double>(cycle.size()) - shift) / 2;
    return sum;
  }
  Place in_space(const Place& place) const {
    if (place.empty()) return {};
    Place point;
    for (const auto& row : *info_.affine) {
      double x = row[3];
      for (std::size_t k = 0; k < std::min<std::size_t>(3, axes()); ++k) x += row[k] * place[k];
      point.push_back(x);
    }
    return point;
  }
  double determinant() const {
    const auto& [x, y, z] = *info_.affine;
    return x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) +
           x[2] * (y[0] * z[1] - y[1] * z[0]);
  }

  const Barcode& bars_;
  const BarcodeInfo& info_;
};

std::string centroid_names(Index axes) {
  std::string text;
  for (Index axis = 0; axis < axes; ++axis) text += fmt::format(",centroid_{}", axis);
  return text;
}

std::string centroid_cells(PointsView centroids, std::size_t i) {
  Place place;
  for (Index axis = 0; axis < centroids.cols(); ++axis)
    place.push_back(centroids(static_cast<Index>(i), axis));
  if (std::ranges::any_of(place, [](double x) { return std::isnan(x); })) place.clear();
  return cells(place, static_cast<std::size_t>(centroids.cols()));
}

}  // namespace

void write_barcode_csv(OutputFile& file, const Barcode& barcode, const BarcodeInfo& info,
                       const BarData& data) {
  const std::span<const double> p_values = data.p_values;
  const bool has_p = !p_values.empty();
  std::optional<PlaceColumns> places;
  if (barcode.representatives() == Representatives::voxels && !info.shape.empty())
    places.emplace(barcode, info);
  const std::string header = places ? places->header() : centroid_names(data.centroids.cols());
  file.write(fmt::format("dim,birth,death{}{}\n", has_p ? ",p" : "", header));
  for (std::size_t i = 0; i < barcode.size(); ++i) {
    const Bar& bar = barcode[i];
    file.write(fmt::format("{},{},{}", bar.dim, shortest(bar.birth), shortest(bar.death)));
    if (has_p)
      file.write(std::isnan(p_values[i]) ? "," : fmt::format(",{}", shortest(p_values[i])));
    file.write(places ? places->row(i) : centroid_cells(data.centroids, i));
    file.write("\n");
  }
}

void write_barcode_pers(OutputFile& file, const Barcode& barcode) {
  for (const Bar& bar : barcode)
    file.write(fmt::format("{} {} {}\n", bar.dim, shortest(bar.birth), shortest(bar.death)));
}

void write_barcode_ripser(OutputFile& file, const Barcode& barcode, int max_dim) {
  for (const Bar& bar : barcode) max_dim = std::max(max_dim, bar.dim);
  for (int dim = 0; dim <= max_dim; ++dim) {
    file.write(fmt::format("persistence intervals in dim {}:\n", dim));
    // Ripser prints infinite bars last.
    for (const Bar& bar : barcode.bars(dim))
      if (!bar.is_infinite())
        file.write(fmt::format(" [{},{})\n", six_digits(bar.birth), six_digits(bar.death)));
    for (const Bar& bar : barcode.bars(dim))
      if (bar.is_infinite()) file.write(fmt::format(" [{}, )\n", six_digits(bar.birth)));
  }
}

}  // namespace ph
