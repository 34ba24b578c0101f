// SPDX-License-Identifier: MIT
// Computes the barcode of points in a file: how many components and loops are there, and at which
// scales?
#include <iostream>
#include <ph/io/read.hpp>
#include <ph/ph.hpp>

int main(int argc, char** argv) {
  const ph::Points points = ph::read_points(argc > 1 ? argv[1] : "points.csv");
  const ph::Barcode bars = ph::persistence(ph::Rips(points), {.max_dim = 1});

  int long_loops = 0;
  for (const ph::Bar& bar : bars.bars(1)) {
    std::cout << "loop [" << bar.birth << ", " << bar.death << ")\n";
    if (bar.persistence() > 0.3) ++long_loops;
  }
  std::cout << bars.bars(0).size() << " components at scale 0, " << long_loops << " long loops\n";

  // Each bar stores its birth cell and its death cell. The birth cell of the longest loop is the
  // edge that closed it.
  const auto closing = bars.birth_cell(bars.longest(1)).numbers;
  std::cout << "the longest loop closed between points " << closing[0] << " and " << closing[1]
            << "\n";
}
