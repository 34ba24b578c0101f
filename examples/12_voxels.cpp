// SPDX-License-Identifier: MIT
// Finds the loops and the void of a point cloud by converting it to voxels. The cost depends on the
// volume instead of the number of pairs of points.
#include <cmath>
#include <iostream>
#include <numbers>
#include <ph/ph.hpp>

int main() {
  constexpr ph::Index around = 300, across = 100;
  constexpr double turn = 2 * std::numbers::pi;
  ph::Points torus(around * across, 3);
  for (ph::Index i = 0; i < torus.rows(); ++i) {
    const double a = turn * static_cast<double>(i / across) / around;
    const double b = turn * static_cast<double>(i % across) / across;
    const double r = 1 + 0.4 * std::cos(b);
    torus.set_row(i, {r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b)});
  }
  const ph::PointImage distances = ph::voxel_image(torus, 0.05);
  const ph::Barcode bars = ph::persistence(ph::Cubical(distances.image), {.min_persistence = 0.2});
  for (int dim = 0; dim <= 2; ++dim) std::cout << bars.bars(dim).size() << " ";
  std::cout << "long bars in dimensions 0, 1 and 2 of " << torus.rows() << " points\n";
}
