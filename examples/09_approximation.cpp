// SPDX-License-Identifier: MIT
// Handles large inputs by a subsample or by a sparse filtration, and handles outliers by DTM
// weights.
#include <cmath>
#include <iostream>
#include <numbers>
#include <ph/ph.hpp>

namespace {

int long_loops(const ph::Barcode& bars, double longer_than) {
  int loops = 0;
  for (const ph::Bar& bar : bars.bars(1)) loops += bar.persistence() > longer_than;
  return loops;
}

}  // namespace

int main() {
  // A slightly blurred circle of radius 1; the last 20 points are outliers inside it.
  const ph::Index count = 2000, outliers = 20;
  ph::Points points(count, 2);
  for (ph::Index i = 0; i < count; ++i) {
    const double turn = std::numbers::pi * (3 - std::sqrt(5.0)) * static_cast<double>(i);
    const double r = i < count - outliers ? 1 + 0.05 * std::sin(17 * turn)
                                          : 0.7 * static_cast<double>(count - i) / outliers;
    points.set_row(i, {r * std::cos(turn), r * std::sin(turn)});
  }
  const ph::PointsView circle(points.data(), count - outliers, points.cols());

  // Bars longer than twice the covering radius correspond to bars of the whole circle.
  const ph::Rips sample(circle, {.subsample = ph::GreedyLimits{.points = 100}});
  const double radius = *sample.covering_radius();
  std::cout << "100 points, covering radius " << radius << ": "
            << long_loops(ph::persistence(sample), 2 * radius) << " real loop\n";

  // Births and deaths are later than the exact values, by a factor of at most 1.5.
  const ph::Rips sparse(circle, {.approximation = 0.5});
  const auto all = static_cast<std::size_t>(circle.rows() * (circle.rows() - 1) / 2);
  std::cout << long_loops(ph::persistence(sparse), 0.5) << " loop in 1/"
            << all / *ph::facts(sparse, ph::plan(sparse)).edges << " of the edges\n";

  // If dtm_neighbours is set, points in sparse regions enter late.
  const ph::Rips weighted(points, {.dtm_neighbours = 40});
  std::cout << long_loops(ph::persistence(weighted), 0.5) << " loop among the outliers\n";
}
