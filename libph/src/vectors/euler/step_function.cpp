// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libph/src/vectors/grid_cells.hpp"
#include "ph/detail/vectors/checked_bars.hpp"
#include "ph/error.hpp"
#include "ph/euler_curve.hpp"

namespace ph {
namespace {

void check(const StepFunction& function) {
  if (function.at.size() != function.value.size())
    throw Error(ErrorKind::usage, fmt::format("StepFunction: found {} places and {} values, "
                                              "expected equal numbers",
                                              function.at.size(), function.value.size()));
}

}  // namespace

std::int64_t StepFunction::operator()(double t) const {
  check(*this);
  const auto behind = std::ranges::upper_bound(at, t);
  return behind == at.begin() ? 0 : value[static_cast<std::size_t>(behind - at.begin()) - 1];
}

void StepFunction::sample(const Grid& grid, std::span<double> out) const {
  check(*this);
  vectors::check(grid, "StepFunction::sample");
  vectors::check_size(out, grid.points, "StepFunction::sample");
  std::size_t next = 0;
  std::int64_t now = 0;
  const std::vector<double> values = grid.values();
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (; next < at.size() && at[next] <= values[i]; ++next) now = value[next];
    out[i] = static_cast<double>(now);
  }
}

StepFunction euler_curve(std::span<const Bar> bars) {
  std::vector<std::pair<double, std::int64_t>> changes;
  changes.reserve(2 * bars.size());
  for (const Bar& bar : bars) {
    vectors::check_bar(bar, "euler_curve");
    const std::int64_t sign = bar.dim % 2 == 0 ? 1 : -1;  // mutant: euler-sign
    changes.emplace_back(bar.birth, sign);
    if (!bar.is_infinite()) changes.emplace_back(bar.death, -sign);
  }
  std::ranges::sort(changes);
  StepFunction curve;
  std::int64_t now = 0;
  for (std::size_t i = 0; i < changes.size();) {
    const double t = changes[i].first;
    const std::int64_t before = now;
    for (; i < changes.size() && changes[i].first == t; ++i) now += changes[i].second;
    if (now == before) continue;
    curve.at.push_back(t + 0.0);
    curve.value.push_back(now);
  }
  return curve;
}

}  // namespace ph
