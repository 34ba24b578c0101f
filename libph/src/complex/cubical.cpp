// SPDX-License-Identifier: MIT
#include "ph/cubical.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <thread>

#include "libph/src/image/voxels_in_use.hpp"
#include "ph/detail/complex/cubical_cells.hpp"
#include "ph/detail/core/file_pages.hpp"
#include "ph/detail/core/radix_sort.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

void check(const Image& image, const CubicalOptions& options) {
  if (image.dim() > Cubical::kMaxDim) {
    throw Error(ErrorKind::usage, fmt::format("image: found {} axes, expected at most {}",
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
  for (std::size_t k = image.extents.size(); k < options.periodic.size(); ++k) {
    if (options.periodic[k]) {
      throw Error(ErrorKind::usage,
                  fmt::format("periodic axis {}: the image has {} axes", k, image.dim()));
    }
  }
}

void refuse_nan(const CubicalImage& grid, const RunContext& context) {
  with_voxels(grid.type, grid.voxels, [&]<class T>(const T* voxels) {
    if constexpr (std::is_floating_point_v<T>) {
      constexpr std::size_t block = 1 << 16;
      const std::size_t count = grid.size();
      for (std::size_t begin = 0; begin < count; begin += block) {
        context.poll();
        if (grid.is_in_file && begin > 0)
          forget_file_pages(voxels + (begin - block), block * sizeof(T));
        const std::size_t end = std::min(count, begin + block);
        bool any = false;  // a loop without branches can be vectorised by the compiler
        for (std::size_t i = begin; i < end; ++i) any |= voxels[i] != voxels[i];
        for (std::size_t i = begin; any && i < end; ++i)
          if (std::isnan(voxels[i]))
            throw Error(ErrorKind::bad_data,
                        fmt::format("{}: found {}, expected a number in an image without a mask",
                                    mark_place(fmt::format("voxel {}", i)), mark_found("nan")));
      }
    }
  });
}

}  // namespace

Cubical::Cubical(const Image& image, const CubicalOptions& options, const RunContext& context)
    : dim_(image.dim()),
      voxels_(image.values),
      context_(&context),
      lazy_(std::make_shared<Lazy>()) {
  check(image, options);
  const std::size_t count = voxels_.size();
  if (count == 0) return;  // a file may hold an image that has neither axes nor voxels
  context.poll();
  claim_ = std::make_shared<MemoryClaim>(context.memory, voxels_.bytes());
  const double most = std::numeric_limits<double>::max();
  grid_.limit = std::min(most, options.threshold.value_or(most));
  if (options.threshold && std::isnan(*options.threshold))
    throw Error(ErrorKind::usage, "threshold: found nan, expected a number");
  grid_.extents = image.extents;
  grid_.periodic = options.periodic;
  grid_.periodic.resize(image.extents.size(), false);
  grid_.type = voxels_.type();
  grid_.voxels = voxels_.data();
  grid_.is_in_file = voxels_.is_in_file();
  grid_.voxels_are_vertices = options.construction == CubicalOptions::Construction::vertices;
  grid_.superlevel = options.superlevel;          // mutant: cubical-superlevel
  if (!image.masked) refuse_nan(grid_, context);  // mutant: cubical-nan

  cells_ = 1;
  for (int k = dim_ - 1; k >= 0; --k) {
    Axis& axis = axes_[k];
    const auto n = static_cast<std::uint64_t>(image.extents[static_cast<std::size_t>(k)]);
    axis.periodic = grid_.periodic[static_cast<std::size_t>(k)];
    axis.stride = cells_;
    axis.length = axis.periodic ? 2 * n : grid_.voxels_are_vertices ? 2 * n - 1 : 2 * n + 1;
    cells_ *= axis.length;
  }
}

void Cubical::prepare(const RunContext& context) const {
  if (cells_ > 0 && lazy_->made.load(std::memory_order_acquire) == nullptr) make_table(context);
}

const Cubical::Table& Cubical::make_table(const RunContext& context) const {
  std::unique_lock lock(lazy_->mutex, std::defer_lock);
  // Another thread is making the table. This thread can still be stopped while it waits.
  while (!lock.try_lock()) {
    context.poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (const Table* made = lazy_->made.load(std::memory_order_relaxed)) return *made;
  const Table& made = lazy_->table.emplace(new_table(context));
  lazy_->made.store(&made, std::memory_order_release);
  return made;
}

Cubical::Table Cubical::new_table(const RunContext& context) const {
  if (voxels_.size() > kNever - 1)
    throw Error(ErrorKind::resource,
                fmt::format("image: found {} voxels, expected at most 2^32 - 2 with an engine that "
                            "lists cells (any engine except gradient)",
                            voxels_.size()));
  // The table may outlive this run. Its memory is therefore counted by the context that the
  // constructor was given.
  Table table{std::pmr::vector<std::uint32_t>(&context_->memory),
              std::pmr::vector<double>(&context_->memory)};
  // The voxels that enter the filtration are ranked by value. Voxels of equal value are ranked by
  // position.
  struct Voxel {
    double value;
    std::uint32_t position;
  };
  std::uint64_t to_spread = 0;
  for (int k = 0; k < dim_; ++k) {
    const std::uint64_t length = axes_[k].length;
    to_spread += cells_ / length * ((grid_.voxels_are_vertices ? length : length + 1) / 2);
  }
  Ticker ticker(context, "cells", to_spread);
  const VoxelsInUse voxels_are_read(grid_, context);
  std::pmr::vector<Voxel> order(&context.memory);
  order.reserve(voxels_.size());
  for (std::size_t i = 0; i < voxels_.size(); ++i) {
    if (const double value = grid_.value(i); value <= grid_.limit)  // mutant: cubical-threshold
      order.push_back({value, static_cast<std::uint32_t>(i)});
    ticker.work();
  }
  radix_sort_by_value(
      order,
      [&](const Voxel& v) {
        ticker.work();
        return v.value;
      },
      context);
  std::optional<MemoryClaim> claim;
  if (&context != context_)
    claim.emplace(context.memory, cells_ * sizeof(std::uint32_t) + order.size() * sizeof(double));
  table.values.reserve(order.size());
  table.keys.reserve(cells_);
  for (const Voxel& v : order) {
    table.values.push_back(v.value);
    ticker.work();
  }
  constexpr std::size_t block = 1 << 12;
  while (table.keys.size() < cells_) {
    const std::size_t more = std::min(block, cells_ - table.keys.size());
    table.keys.insert(table.keys.end(), more, kNever);
    ticker.work(more);
  }

  // Voxels have even coordinates in the V-construction and odd coordinates in the T-construction.
  // In the V-construction, a cube enters with its last vertex. In the T-construction, a face enters
  // with its first coface. The keys of the voxels are therefore spread to the other cells, along
  // one axis after another.
  const std::uint64_t voxel_parity = grid_.voxels_are_vertices ? 0 : 1;
  const auto grid_index = [&](std::uint64_t voxel) {
    std::uint64_t index = 0;
    for (int k = dim_ - 1; k >= 0; --k) {
      const auto n = static_cast<std::uint64_t>(grid_.extents[static_cast<std::size_t>(k)]);
      index += (2 * (voxel % n) + voxel_parity) * axes_[k].stride;
      voxel /= n;
    }
    return index;
  };
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    table.keys[grid_index(order[rank].position)] = static_cast<std::uint32_t>(rank);
    ticker.work();
  }
  for (int k = 0; k < dim_; ++k)
    spread_keys(table.keys, axes_[k], grid_.voxels_are_vertices, ticker);
  return table;
}

void Cubical::spread_keys(std::pmr::vector<std::uint32_t>& keys, const Axis& axis,
                          bool voxels_are_vertices, Ticker& ticker) {
  constexpr std::uint64_t block = 1 << 12;
  const std::uint64_t last = axis.length - 1, slab = axis.stride * axis.length;
  for (std::uint64_t first = 0; first < keys.size(); first += slab) {
    for (std::uint64_t x = voxels_are_vertices ? 1 : 0; x <= last; x += 2) {
      // Layer x of the axis has a layer below it and a layer above it. At the border of a
      // T-construction, only one of the two exists.
      const bool has_lower = x > 0 || axis.periodic, has_upper = x < last || axis.periodic;
      // mutant: cubical-wrap
      const std::uint64_t below = x > 0 ? x - 1 : last, above = x < last ? x + 1 : 0;
      std::uint32_t* layer = keys.data() + first + x * axis.stride;
      const std::uint32_t* lower = keys.data() + first + (has_lower ? below : above) * axis.stride;
      const std::uint32_t* upper = keys.data() + first + (has_upper ? above : below) * axis.stride;
      for (std::uint64_t i = 0; i < axis.stride;) {
        const std::uint64_t begin = i, end = std::min(axis.stride, begin + block);
        for (; i < end; ++i) {
          layer[i] =
              voxels_are_vertices ? std::max(lower[i], upper[i]) : std::min(lower[i], upper[i]);
        }
        ticker.tick(end - begin);
      }
    }
  }
}

void Cubical::append_input_cell(int, const Cell& cell, std::vector<Index>& numbers) const {
  for (int k = 0; k < dim_; ++k)
    numbers.push_back(static_cast<Index>(coordinate(cell.index, axes_[k])));
}

std::size_t Cubical::vertex_count() const {
  if (cells_ == 0) return 0;
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
