// SPDX-License-Identifier: MIT
// Computes the barcode of a volume: a hollow box of value 1 in a background of 9.
#include <iostream>
#include <ph/ph.hpp>

int main() {
  // Arrays of bytes, short integers and floats work as well.
  std::vector<double> voxels(7 * 7 * 7, 9.0);
  const auto at = [&](int x, int y, int z) -> double& {
    return voxels[static_cast<std::size_t>((x * 7 + y) * 7 + z)];
  };
  for (int x = 1; x <= 5; ++x)
    for (int y = 1; y <= 5; ++y)
      for (int z = 1; z <= 5; ++z) at(x, y, z) = 1;
  for (int x = 2; x <= 4; ++x)
    for (int y = 2; y <= 4; ++y)
      for (int z = 2; z <= 4; ++z) at(x, y, z) = 9;

  const ph::Barcode bars = ph::persistence(ph::Cubical(ph::Image{{7, 7, 7}, voxels}));
  for (const ph::Bar& bar : bars.bars(2)) {
    std::cout << bars.bars(2).size() << " void, born at " << bar.birth << ", filled at "
              << bar.death << "\n";
  }
}
