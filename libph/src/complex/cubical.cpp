// SPDX-License-Identifier: MIT
#include "ph/complex/cubical.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "ph/core/error.hpp"
#include "ph/core/radix_sort.hpp"

namespace ph {
namespace {

void check(const Image& image, const CubicalOptions& options) {
  if (image.dim() > Cubical::kMaxDim) {
    throw Error(ErrorKind::usage, fmt::format("image: found {} axes, at most {} are possible",
                                              image.dim(), Cubical::kMaxDim));
  }
  Index voxels = 1;
  for (const Index n : image.extents) {
    if (n < 1) {
      throw Error(ErrorKind::bad_data, fmt::format("image: found extents {}, expected each >= 1",
                                                   fmt::join(image.extents, " x ")));
    }
    if (__builtin_mul_overflow(voxels, n, &voxels)) voxels = std::numeric_limits<Index>::max();
  }
  if (image.extents.empty()) voxels = static_cast<Index>(image.values.size());
  if (static_cast<Index>(image.values.size()) != voxels || (image.dim() == 0 && voxels > 1)) {
    throw Error(ErrorKind::bad_data,
                fmt::format("image: found {} values, expected {}", image.values.size(), voxels));
  }
  if (voxels > Index{UINT32_MAX} - 1) {
    throw Error(ErrorKind::resource,
                fmt::format("image: found {} voxels, at most 2^32 - 2 are possible", voxels));
  }
  for (std::size_t k = image.extents.size(); k < options.periodic.size(); ++k) {
    if (options.periodic[k]) {
      throw Error(ErrorKind::usage,
                  fmt::format("periodic axis {}: the image has {} axes", k, image.dim()));
    }
  }
}

}  // namespace

Cubical::Cubical(const Image& image, const CubicalOptions& options, const RunContext& context)
    : dim_(image.dim()), keys_(&context.memory), values_(&context.memory) {
  check(image, options);
  const std::size_t voxels = image.values.size();
  if (voxels == 0) return;  // a file may hold an image of no dimension and no voxel
  const bool voxels_are_vertices = options.construction == CubicalOptions::Construction::vertices;

  // Ranks of the voxels that enter, by (value, position).
  struct Voxel {
    double value;
    std::uint32_t position;
  };
  std::pmr::vector<Voxel> order(&context.memory);
  order.reserve(voxels);
  const double limit = options.threshold.value_or(std::numeric_limits<double>::max());
  if (std::isnan(limit)) throw Error(ErrorKind::usage, "threshold: found nan, expected a number");
  for (std::size_t i = 0; i < voxels; ++i) {
    const double value = (options.superlevel ? -image.values[i] : image.values[i]) + 0.0;
    if (std::isnan(value)) {
      throw Error(ErrorKind::bad_data, fmt::format("voxel {}: found nan, expected a number", i));
    }
    if (value <= limit && value < std::numeric_limits<double>::infinity())
      order.push_back({value, static_cast<std::uint32_t>(i)});
  }
  context.poll();
  radix_sort_by_value(order, [](const Voxel& v) { return v.value; });
  context.poll();
  values_.reserve(order.size());
  for (const Voxel& v : order) values_.push_back(v.value);

  // The doubled grid.
  std::uint64_t cells = 1;
  for (int k = dim_ - 1; k >= 0; --k) {
    Axis& axis = axes_[k];
    const auto n = static_cast<std::uint64_t>(image.extents[static_cast<std::size_t>(k)]);
    axis.periodic = static_cast<std::size_t>(k) < options.periodic.size() &&
                    options.periodic[static_cast<std::size_t>(k)];
    axis.stride = cells;
    axis.length = axis.periodic ? 2 * n : voxels_are_vertices ? 2 * n - 1 : 2 * n + 1;
    cells *= axis.length;
  }
  keys_.assign(cells, kNever);

  // Voxels stand at the even coordinates (V) or the odd ones (T). A cube of V enters with the last
  // of its vertices, a face of T with the first of its cofaces: spread the keys axis by axis.
  const std::uint64_t voxel_parity = voxels_are_vertices ? 0 : 1;
  const auto grid_index = [&](std::uint64_t voxel) {
    std::uint64_t index = 0;
    for (int k = dim_ - 1; k >= 0; --k) {
      const auto n = static_cast<std::uint64_t>(image.extents[static_cast<std::size_t>(k)]);
      index += (2 * (voxel % n) + voxel_parity) * axes_[k].stride;
      voxel /= n;
    }
    return index;
  };
  for (std::size_t rank = 0; rank < order.size(); ++rank)
    keys_[grid_index(order[rank].position)] = static_cast<std::uint32_t>(rank);

  for (int k = 0; k < dim_; ++k) {
    spread_keys(axes_[k], voxels_are_vertices);
    context.poll();
  }
}

void Cubical::spread_keys(const Axis& axis, bool voxels_are_vertices) {
  const std::uint64_t last = axis.length - 1, slab = axis.stride * axis.length;
  for (std::uint64_t first = 0; first < keys_.size(); first += slab) {
    for (std::uint64_t x = voxels_are_vertices ? 1 : 0; x <= last; x += 2) {
      // The layers below and above along the axis; at a border of T there is only one.
      const bool has_lower = x > 0 || axis.periodic, has_upper = x < last || axis.periodic;
      const std::uint64_t below = x > 0 ? x - 1 : last, above = x < last ? x + 1 : 0;
      std::uint32_t* layer = keys_.data() + first + x * axis.stride;
      const std::uint32_t* lower = keys_.data() + first + (has_lower ? below : above) * axis.stride;
      const std::uint32_t* upper = keys_.data() + first + (has_upper ? above : below) * axis.stride;
      for (std::uint64_t i = 0; i < axis.stride; ++i) {
        layer[i] =
            voxels_are_vertices ? std::max(lower[i], upper[i]) : std::min(lower[i], upper[i]);
      }
    }
  }
}

void Cubical::append_input_cell(int, const Cell& cell, std::vector<Index>& numbers) const {
  for (int k = 0; k < dim_; ++k)
    numbers.push_back(static_cast<Index>(coordinate(cell.index, axes_[k])));
}

std::size_t Cubical::vertex_count() const {
  if (keys_.empty()) return 0;
  std::size_t count = 1;
  for (int k = 0; k < dim_; ++k) count *= (axes_[k].length + 1) / 2;
  return count;
}

std::size_t Cubical::vertex_number(const Cell& vertex) const {
  std::size_t number = 0;
  for (int k = 0; k < dim_; ++k)
    number = number * ((axes_[k].length + 1) / 2) + coordinate(vertex.index, axes_[k]) / 2;
  return number;
}

}  // namespace ph
