// SPDX-License-Identifier: MIT
// The library ph::alpha contains the constructor of alpha complexes and the code that only this
// constructor needs. No other library uses CGAL. The rest of the folder belongs to ph::core.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libph/src/alpha/alpha_lazy.hpp"
#include "libph/src/alpha/intervals/frames.hpp"
#include "libph/src/alpha/intervals/intervals.hpp"
#include "libph/src/alpha/listed_simplices.hpp"
#include "libph/src/alpha/periodic/quotient.hpp"
#include "ph/error.hpp"

namespace ph {
namespace alpha {
namespace {

/// True if any axis is periodic.
bool closes_up(std::span<const double> period) {
  return std::ranges::any_of(period, [](double length) { return length != 0; });
}

void find_intervals(AlphaCells& cells, Images* images, const RunContext& context) {
  if (cells.dim() > 0) {
    cells.cell_values.resize(cells.triangulation.size());
    cells.beyond.resize(cells.triangulation.size());
    if (cells.dim() == 3)
      cells.edges = number_edges(cells.triangulation, cells.sites.size(), images, context);
    const Frames frames(cells, images);
    if (cells.dim() == 3)
      find_intervals_of_space(cells, frames, context);
    else
      find_intervals_of_plane(cells, frames, context);
    make_monotone(cells, frames, context);
  } else if (cells.sites.is_weighted() && cells.dim() == 0) {
    cells.vertex_values.assign(1, -cells.sites.weights[0] + 0.0);
    cells.vertex_up.assign(1, kCritical);
  }
}

}  // namespace

AlphaCells alpha_cells(PointsView points, std::span<const double> weights,
                       std::span<const double> period, const RunContext& context) {
  const bool is_periodic = closes_up(period);
  std::optional<Folded> folded;
  double largest = 0;
  if (is_periodic) {
    folded = fold_points(points, weights, period);
    points = folded->points;
    largest = folded->box.size;
  }
  std::pmr::memory_resource* const memory = &context.memory;
  AlphaCells cells(sites_of(points, weights, context, largest), memory);
  cells.is_periodic = is_periodic && cells.sites.size() > 0;
  if (cells.is_periodic) cells.period.assign(period.begin(), period.end());
  std::optional<Images> images;
  if (cells.is_periodic) {
    auto periodic = triangulate_periodic(
        cells.sites, folded->box.times_power_of_two(-cells.sites.exponent), context);
    cells.triangulation = std::move(periodic.triangulation);
    images.emplace(std::move(periodic.images));
  } else {
    cells.triangulation = triangulate(cells.sites, context);
  }
  folded.reset();
  if (cells.sites.is_weighted()) remove_hidden(cells.sites, cells.triangulation, cells.hidden);
  find_intervals(cells, images ? &*images : nullptr, context);
  if (!images) check_lemmas(cells);
  return cells;
}

}  // namespace alpha

namespace {

/// Checks that two kinds of squares are within the range of doubles: the squares of coordinates
/// below 2^exponent, and the squares of the units in the last place of such coordinates. @throws
/// Error (bad_data) if they are not within this range.
void check_squares(int exponent) {
  // The lower limit is 2^-916 for squares, which leaves room for 106 more binary places.
  constexpr int most = 511, least = -458;
  if (exponent >= least && exponent <= most) return;  // mutant: alpha-exponent
  throw Error(ErrorKind::bad_data,
              fmt::format("alpha complex: found coordinates of about 2^{}, expected 2^{} to 2^{} "
                          "for squared values; use radii instead",
                          exponent, least, most));
}

}  // namespace

Alpha::Alpha(PointsView points, const AlphaOptions& options, const RunContext& context)
    : lazy_(std::make_shared<Lazy>(context)),
      unit_(options.unit),
      kind_(options.value),
      threshold_(options.threshold) {
  if (std::isnan(threshold_))
    throw Error(ErrorKind::usage, "threshold: found nan, expected a number");
  if (!options.weights.empty() && unit_ == AlphaOptions::Unit::radius)
    throw Error(ErrorKind::usage,
                "alpha complex with weights: found unit 'radius', expected 'squared', because "
                "squared radii may be negative");
  if (!options.weights.empty() && kind_ != AlphaOptions::Value::alpha)
    throw Error(ErrorKind::usage,
                fmt::format("alpha complex with weights: found {} values, expected alpha values",
                            name_of(kind_)));
  if (alpha::closes_up(options.period) && kind_ != AlphaOptions::Value::alpha)
    throw Error(
        ErrorKind::usage,
        fmt::format("alpha complex of a periodic space: found {} values, expected alpha values",
                    name_of(kind_)));
  cells_ = std::make_shared<const alpha::AlphaCells>(
      alpha::alpha_cells(points, options.weights, options.period, context));
  if (unit_ == AlphaOptions::Unit::squared) check_squares(cells_->sites.exponent);
  const auto enters = [&](double r) { return to_value(r) <= threshold_; };
  if (kind_ != AlphaOptions::Value::alpha)
    lazy_->set(alpha::list_with_other_values(*cells_, kind_, enters, context));
  top_dim_ = lazy_->listed ? lazy_->listed->top_dim() : alpha::top_dim(*cells_, enters);
}

}  // namespace ph
