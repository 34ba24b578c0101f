// SPDX-License-Identifier: MIT
#include "ph/alpha.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "alpha/intervals/intervals.hpp"
#include "alpha/listed_simplices.hpp"
#include "alpha/other_values.hpp"
#include "alpha/sites/power_of_two.hpp"
#include "ph/error.hpp"

namespace ph {

struct Alpha::Lazy {
  explicit Lazy(const RunContext& made_with) : context(&made_with) {}
  std::mutex mutex;
  std::atomic<const ExplicitComplex*> ready{nullptr};
  std::optional<ExplicitComplex> listed;
  const RunContext* context;
};

Alpha::Alpha(PointsView points, const AlphaOptions& options, const RunContext& context)
    : lazy_(std::make_shared<Lazy>(context)),
      unit_(options.unit),
      kind_(options.value),
      threshold_(options.threshold) {
  if (std::isnan(threshold_))
    throw Error(ErrorKind::usage, "threshold: found nan, expected a number");
  if (!options.weights.empty() && unit_ == AlphaOptions::Unit::radius)
    throw Error(ErrorKind::usage,
                "alpha complex of weighted points: found the unit radius, expected squared, for "
                "squares may be negative");
  if (!options.weights.empty() && kind_ != AlphaOptions::Value::alpha)
    throw Error(ErrorKind::usage,
                "alpha complex of weighted points: found values other than alpha, which are for "
                "points without weights");
  cells_ = std::make_shared<const alpha::AlphaCells>(
      alpha::alpha_cells(points, options.weights, context));
  top_dim_ = kind_ == AlphaOptions::Value::alpha
                 ? alpha::top_dim(*cells_, [&](double r) { return to_value(r) <= threshold_; })
                 : listed().top_dim();
}

double Alpha::to_value(double squared_radius) const {
  const int exponent = cells_->sites.exponent;
  using alpha::times_power_of_two;
  const double value = unit_ == AlphaOptions::Unit::squared
                           ? times_power_of_two(squared_radius, 2 * exponent)
                           : times_power_of_two(std::sqrt(squared_radius), exponent);
  return std::min(value, std::numeric_limits<double>::max());
}

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
  lazy_->listed.emplace(kind_ == AlphaOptions::Value::alpha
                            ? alpha::list_simplices(*cells_, enters, context)
                            : alpha::list_with_other_values(*cells_, kind_, enters, context));
  lazy_->ready.store(&*lazy_->listed, std::memory_order_release);
}

const ExplicitComplex& Alpha::listed() const {
  prepare(*lazy_->context);
  return *lazy_->ready.load(std::memory_order_acquire);
}

}  // namespace ph
