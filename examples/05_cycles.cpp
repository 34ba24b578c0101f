// SPDX-License-Identifier: MIT
// Locates the loop of the longest bar of H1: prints the shortest closed walk around the loop, point
// by point.
#include <iostream>
#include <ph/io/read.hpp>
#include <ph/ph.hpp>

int main(int argc, char** argv) {
  const ph::Points points = ph::read_points(argc > 1 ? argv[1] : "points.csv");
  const ph::Rips rips(points);
  const ph::Options options{.representatives = ph::Representatives::cycles};
  const ph::Barcode bars = ph::persistence(rips, options);

  const std::size_t longest = bars.longest(1);
  const ph::BarLoops found = ph::loops(rips, bars, options)[longest];
  std::cout << "[" << bars[longest].birth << ", " << bars[longest].death << ")\n";
  for (const ph::Loop& loop : found.loops) {
    std::cout << "loop";
    for (const ph::Index point : loop.numbers) std::cout << " " << point;
    std::cout << "\n" << loop.numbers.size() << " steps, length " << *loop.length << "\n";
  }
  std::cout << (found.tightness == ph::Tightness::shortest ? "no loop is shorter\n"
                                                           : "steps do not shorten it\n");
}
