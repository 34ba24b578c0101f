// SPDX-License-Identifier: MIT
// Prints the voxels of a component of an image, and the voxels of a void.
#include <iostream>
#include <ph/ph.hpp>

int main() {
  const ph::Image image{{5, 6}, {9, 9, 9, 9, 9, 9,  //
                                 9, 1, 1, 1, 9, 3,  //
                                 9, 1, 7, 1, 9, 3,  //
                                 9, 1, 1, 1, 9, 9,  //
                                 9, 9, 9, 9, 9, 9}};
  const ph::Barcode bars =
      ph::persistence(ph::Cubical(image), {.representatives = ph::Representatives::voxels});
  for (std::size_t i = 0; i < bars.size(); ++i) {
    if (bars[i].is_infinite()) continue;
    std::cout << "H" << bars[i].dim << " [" << bars[i].birth << ", " << bars[i].death << "):";
    for (const std::uint32_t place : bars.voxels(i))
      std::cout << " (" << place / 6 << ", " << place % 6 << ")";
    std::cout << "\n";
  }
}
