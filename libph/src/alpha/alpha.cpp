// SPDX-License-Identifier: MIT
#include "ph/alpha.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libph/src/alpha/alpha_lazy.hpp"
#include "libph/src/alpha/intervals/intervals.hpp"
#include "libph/src/alpha/listed_simplices.hpp"
#include "libph/src/alpha/sites/power_of_two.hpp"

namespace ph {

double Alpha::to_value(double squared_radius) const {
  const int exponent = cells_->sites.exponent;
  using alpha::times_power_of_two;
  const double value = unit_ == AlphaOptions::Unit::squared
                           ? times_power_of_two(squared_radius, 2 * exponent)
                           : times_power_of_two(std::sqrt(squared_radius), exponent);
  return std::min(value, std::numeric_limits<double>::max());
}

bool Alpha::is_weighted() const { return cells_->sites.is_weighted(); }

bool Alpha::is_periodic() const { return cells_->is_periodic; }

std::span<const std::uint32_t> Alpha::hidden() const { return cells_->hidden; }

std::vector<Index> Alpha::copies() const {
  std::vector<Index> copies;
  for (const auto& [copy, site] : cells_->sites.copies) copies.push_back(copy);
  std::ranges::sort(copies);
  return copies;
}

std::vector<std::size_t> Alpha::simplex_counts() const { return alpha::simplex_counts(*cells_); }

void Alpha::prepare(const RunContext& context) const {
  if (lazy_->ready.load(std::memory_order_acquire) != nullptr) return;
  const std::lock_guard lock(lazy_->mutex);
  if (lazy_->listed) return;
  const auto enters = [&](double r) { return to_value(r) <= threshold_; };
  lazy_->set(cells_->is_periodic ? alpha::list_cells(*cells_, enters, lazy_->vertices, context)
                                 : alpha::list_simplices(*cells_, enters, context));
}

const ExplicitComplex& Alpha::listed() const {
  prepare(*lazy_->context);
  return *lazy_->ready.load(std::memory_order_acquire);
}

void Alpha::append_input_cell(int dim, Cell cell, std::vector<Index>& numbers) const {
  const ExplicitComplex& all = listed();
  all.append_input_cell(dim, cell, numbers);
  if (!cells_->is_periodic) return;
  const auto vertices = lazy_->vertices.simplex(static_cast<std::size_t>(numbers.back()));
  numbers.pop_back();
  numbers.insert(numbers.end(), vertices.begin(), vertices.end());
}

std::size_t Alpha::vertex_count() const {
  return cells_->sites.size() + cells_->sites.copies.size() + cells_->hidden.size();
}

std::size_t Alpha::vertex_number(Cell vertex) const {
  std::vector<Index> point;
  append_input_cell(0, vertex, point);
  return static_cast<std::size_t>(point[0]);  // mutant: alpha-tree-vertex
}

}  // namespace ph
