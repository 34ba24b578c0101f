// SPDX-License-Identifier: MIT
#pragma once
// How Cubical lists cells, facets and cofacets; included by ph/custom.hpp.
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "ph/cubical.hpp"

namespace ph {

struct Cubical::Table {
  std::pmr::vector<std::uint32_t> keys;  // by grid index; kNever if the cell never enters
  std::pmr::vector<double> values;       // by key
};

struct Cubical::Lazy {
  std::mutex mutex;
  std::optional<Table> table;
  std::atomic<const Table*> made{nullptr};
};

inline const Cubical::Table& Cubical::table() const {
  if (const Table* made = lazy_->made.load(std::memory_order_acquire)) return *made;
  return make_table(*context_);
}

inline double Cubical::value(const Cell& c) const { return table().values[c.key]; }

template <class Visit>
void Cubical::for_each_cell(int dim, Visit&& visit) const {
  if (dim < 0 || dim > dim_ || cells_ == 0) return;
  const auto& keys = table().keys;
  const auto axes = static_cast<std::size_t>(dim_);
  // Visits the possible sets of axes with odd coordinates one after another. The cells of one set
  // are visited in grid order.
  for (unsigned odd = 0; odd < (1U << dim_); ++odd) {
    if (std::popcount(odd) != dim) continue;
    std::array<std::uint64_t, kMaxDim> at{};
    std::uint64_t index = 0;
    bool empty = false;
    for (std::size_t k = 0; k < axes; ++k) {
      at[k] = odd >> k & 1;
      empty = empty || at[k] >= axes_[k].length;
      index += at[k] * axes_[k].stride;
    }
    while (!empty) {
      if (keys[index] != kNever) visit(Cell{keys[index], index});
      bool is_last = true;
      for (std::size_t k = axes; k-- > 0;) {
        at[k] += 2;
        index += 2 * axes_[k].stride;
        is_last = at[k] >= axes_[k].length;
        if (!is_last) break;
        const std::uint64_t first = odd >> k & 1;
        index -= (at[k] - first) * axes_[k].stride;
        at[k] = first;
      }
      if (is_last) break;
    }
  }
}

// Incidence: the boundary of a product of intervals, axis by axis,
//   d(I_1 x … x I_d) = sum over the odd axes k of (-1)^(odd axes before k) (upper - lower end),
// see Kaczynski, Mischaikow, Mrozek, Computational Homology, section 2.2.
template <class Visit>
void Cubical::for_each_facet(int, const Cell& cell, Visit&& visit) const {
  const auto& keys = table().keys;
  int sign = 1;
  for (int k = 0; k < dim_; ++k) {
    const Axis& axis = axes_[static_cast<std::size_t>(k)];
    const std::uint64_t x = coordinate(cell.index, axis);
    if (x % 2 == 0) continue;
    // On a circle of one edge, both ends are the same vertex and cancel.
    if (axis.length > 2 || !axis.periodic) {
      const std::uint64_t lower = cell.index - axis.stride;
      const std::uint64_t upper =
          x + 1 < axis.length ? cell.index + axis.stride : cell.index - x * axis.stride;
      visit(Cell{keys[upper], upper}, sign);
      visit(Cell{keys[lower], lower}, -sign);  // mutant: cubical-edge-sign
    }
    sign = -sign;  // mutant: cubical-axis-sign
  }
}

template <class Visit>
void Cubical::for_each_cofacet(int, const Cell& cell, Visit&& visit) const {
  struct Cofacet {
    std::uint64_t index;
    int incidence;
  };
  // Cofacets are visited in grid order: the first cofacet with the key of the cell is therefore the
  // oldest. Without wrapping, grid order means: first the cofacets below the cell, from the slowest
  // axis to the fastest, then the cofacets above it, from the fastest axis to the slowest.
  std::array<Cofacet, 2 * kMaxDim> cofacets;
  int down = 0, up = 2 * kMaxDim;
  int sign = 1;
  bool wrapped = false;
  for (int k = 0; k < dim_; ++k) {
    const Axis& axis = axes_[static_cast<std::size_t>(k)];
    const std::uint64_t x = coordinate(cell.index, axis);
    if (x % 2 == 1) {
      sign = -sign;
      continue;
    }
    if (axis.periodic && axis.length == 2) continue;
    const std::uint64_t last = axis.length - 1;
    // The cell is the upper end of the cofacet below it and the lower end of the cofacet above it.
    if (x > 0) {
      cofacets[down++] = {cell.index - axis.stride, sign};
    } else if (axis.periodic) {
      cofacets[down++] = {cell.index + last * axis.stride, sign};
      wrapped = true;
    }
    if (x < last) cofacets[--up] = {cell.index + axis.stride, -sign};
  }
  int count = down;
  for (; up < 2 * kMaxDim; ++up) cofacets[count++] = cofacets[up];
  if (wrapped) {                     // mutant: cubical-wrapped
    for (int i = 1; i < count; ++i)  // insertion sort: the array is short and nearly sorted
      for (int j = i; j > 0 && cofacets[j].index < cofacets[j - 1].index; --j)
        std::swap(cofacets[j], cofacets[j - 1]);
  }
  const auto& keys = table().keys;
  for (int i = 0; i < count; ++i) {
    const std::uint32_t key = keys[cofacets[i].index];
    if (key != kNever && !visit(Cell{key, cofacets[i].index}, cofacets[i].incidence)) return;
  }
}

}  // namespace ph
