// SPDX-License-Identifier: MIT
// Uses a threshold and another field for many points. Only pairs of points within the threshold are
// examined.
#include <cmath>
#include <iostream>
#include <numbers>
#include <ph/ph.hpp>

int main() {
  // Places points on a sphere along a golden spiral.
  ph::Points sphere(600, 3);
  for (ph::Index i = 0; i < sphere.rows(); ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(sphere.rows());
    const double turn = std::numbers::pi * (3 - std::sqrt(5.0)) * static_cast<double>(i);
    const double r = std::sqrt(1 - z * z);
    sphere.set_row(i, {r * std::cos(turn), r * std::sin(turn), z});
  }

  const ph::SparseDistances near = ph::SparseDistances::within(sphere, 0.3);
  std::cout << near.edges().size() << " pairs of " << 600 * 599 / 2 << " are within 0.3\n";

  const ph::Barcode bars = ph::persistence(ph::Rips(near), {.max_dim = 2, .field = 3});
  int voids = 0;
  for (const ph::Bar& bar : bars.bars(2)) voids += bar.is_infinite();
  std::cout << "over Z/3: " << voids << " void still open at the threshold\n";
}
