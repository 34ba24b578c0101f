// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "libph/src/vectors/grid_cells.hpp"
#include "libph/src/vectors/long_sum.hpp"
#include "ph/detail/vectors/checked_bars.hpp"

namespace ph {
namespace vectors {
namespace {

/// Sums over the bars that are alive at each value of a grid. Changes are stored at the places
/// where they happen and added up in a single pass.
class LivingBars {
 public:
  explicit LivingBars(const GridCells& cells) : changes_(cells.size() + 1) {}

  /// Adds x to the sums from place `from` up to, but not including, place `to`.
  void add(std::size_t from, std::size_t to, double x) {
    ++changes_[from].bars;
    --changes_[to].bars;
    changes_[from].sum.add(x);
    changes_[to].sum.add(-x);
  }
  /// Calls use(place, bars, sum) for each place, with the number of bars alive there. If no bar is
  /// alive, the sum is exactly 0.
  template <class Use>
  void walk(Use&& use) const {
    Change now;
    for (std::size_t i = 0; i + 1 < changes_.size(); ++i) {
      now.bars += changes_[i].bars;
      now.sum.add(changes_[i].sum);
      use(i, now.bars, now.bars == 0 ? 0.0 : now.sum.value());
    }
  }

 private:
  struct Change {
    std::int64_t bars = 0;
    LongSum sum;
  };
  std::vector<Change> changes_;
};

}  // namespace
}  // namespace vectors

void betti_curve(std::span<const Bar> given, const Grid& grid, std::span<double> out) {
  const vectors::GridCells cells(grid, "betti_curve");
  vectors::check_size(out, grid.points, "betti_curve");
  std::vector<std::int64_t> changes(cells.size() + 1);
  for (const Bar& bar : vectors::checked_bars(given, vectors::Ends::any, "betti_curve")) {
    ++changes[cells.first_from(bar.birth)];
    --changes[cells.first_from(bar.death)];
  }
  std::int64_t living = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) out[i] = static_cast<double>(living += changes[i]);
}

void life_entropy_curve(std::span<const Bar> given, const Grid& grid, std::span<double> out) {
  const vectors::GridCells cells(grid, "life_entropy_curve");
  vectors::check_size(out, grid.points, "life_entropy_curve");
  const std::vector<Bar> bars =
      vectors::checked_bars(given, vectors::Ends::finite, "life_entropy_curve");
  vectors::LongSum total;
  for (const Bar& bar : bars) total.add(bar.persistence());
  vectors::LivingBars living(cells);
  for (const Bar& bar : bars) {
    const double share = bar.persistence() / total.value();  // mutant: entropy-share
    living.add(cells.first_from(bar.birth), cells.first_from(bar.death),
               share > 0 ? -share * std::log(share) : 0);
  }
  living.walk([&](std::size_t i, std::int64_t, double sum) { out[i] = std::max(0.0, sum); });
}

void silhouette(std::span<const Bar> given, const Grid& grid, double power, std::span<double> out) {
  const vectors::GridCells cells(grid, "silhouette");
  vectors::check_size(out, grid.points, "silhouette");
  vectors::check_power(power, "silhouette");
  const std::vector<Bar> bars = vectors::checked_bars(given, vectors::Ends::finite, "silhouette");
  std::ranges::fill(out, 0);
  if (bars.empty()) return;
  double longest = 0;
  for (const Bar& bar : bars) longest = std::max(longest, bar.persistence());
  // The tent of a bar from b to d with weight w is w t - w b where it rises and w d - w t where it
  // falls. The coefficients of t and the constants are summed separately. All numbers are relative
  // to the middle of the grid, because smaller numbers have smaller rounding errors.
  const double middle = grid.lo / 2 + grid.hi / 2;
  vectors::LivingBars slopes(cells), constants(cells);
  vectors::LongSum weights;
  for (const Bar& bar : bars) {
    const double weight = std::pow(bar.persistence() / longest, power);
    const std::size_t from = cells.first_from(bar.birth), to = cells.first_from(bar.death);
    const std::size_t top = std::clamp(cells.first_falling(bar), from, to);
    weights.add(weight);
    slopes.add(from, top, weight);
    slopes.add(top, to, -weight);  // mutant: silhouette-falls
    constants.add(from, top, -weight * (bar.birth - middle));
    constants.add(top, to, weight * (bar.death - middle));
  }
  slopes.walk(
      [&](std::size_t i, std::int64_t, double slope) { out[i] = slope * (cells[i] - middle); });
  constants.walk([&](std::size_t i, std::int64_t living, double constant) {
    out[i] = living == 0 ? 0 : std::max(0.0, (out[i] + constant) / weights.value());
  });
}

}  // namespace ph
