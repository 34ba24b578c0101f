// SPDX-License-Identifier: MIT
// Finds the objects that have a handle or a hole: segments a ring and a ball, and computes their
// homology.
//
// 11_handles [CLOUD.pcd|.ply]
#include <cmath>
#include <iostream>
#include <numbers>
#include <ph/segment.hpp>
#include <span>
#include <vector>

namespace {

/// An upright ring and a ball; neighbouring points are 2 mm apart.
std::vector<float> ring_and_ball() {
  constexpr double turn = 2 * std::numbers::pi, step = 0.002;
  std::vector<float> xyz;
  const auto add = [&](double x, double y, double z) {
    for (const double c : {x, y, z}) xyz.push_back(static_cast<float>(c));
  };
  for (double a = 0; a < turn; a += step / 0.04)
    for (double b = 0; b < turn; b += step / 0.008) {
      const double r = 0.04 + 0.008 * std::cos(b);
      add(r * std::cos(a), r * std::sin(a), 0.8 + 0.008 * std::sin(b));
    }
  for (double a = 0; a < turn / 4; a += step / 0.04)  // only the part that a camera sees
    for (double b = 0; b < turn; b += step / 0.04)
      add(0.2 + 0.04 * std::sin(a) * std::cos(b), 0.04 * std::sin(a) * std::sin(b),
          0.8 - 0.04 * std::cos(a));
  return xyz;
}

}  // namespace

int main(int argc, char** argv) {
  const auto scene = argc > 1 ? ph::segment::segment(ph::segment::read_cloud(argv[1]))
                              : ph::segment::segment({ring_and_ball(), {}}, {.plane = false});
  for (const auto& segment : scene.cut.segments) {
    const auto shape = ph::segment::signature(scene.tree, scene.cut, std::span(&segment.label, 1));
    std::cout << "segment " << segment.label << ":";
    for (const auto& loop : shape.bars(1))
      if (loop.death - loop.birth > 0.01)  // metres
        std::cout << " a loop through which a ball of " << std::lround(2000 * loop.death)
                  << " mm fits;";
    std::cout << " " << shape.bars(2).size() << " hollows\n";
  }
}
