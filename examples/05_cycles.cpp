// SPDX-License-Identifier: MIT
// Where is the loop? The cycle that came with the longest bar, as a walk from point to point.
#include <iostream>
#include <map>
#include <ph/io/read.hpp>
#include <ph/ph.hpp>

int main(int argc, char** argv) {
  const ph::Points points = ph::read_points(argc > 1 ? argv[1] : "points.csv");
  const ph::Barcode bars =
      ph::persistence(ph::Rips(points), {.representatives = ph::Representatives::cycles});

  // The edges of the cycle. Over Z/2 all coefficients are 1.
  const std::size_t longest = bars.longest(1);
  const ph::InputChain cycle = bars.representative(longest);
  std::multimap<ph::Index, ph::Index> neighbours;
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    const auto edge = cycle.cell(i).numbers;
    neighbours.emplace(edge[0], edge[1]);
    neighbours.emplace(edge[1], edge[0]);
  }

  // An even number of edges meet in each point, so a walk that uses no edge twice comes back.
  std::cout << "loop [" << bars[longest].birth << ", " << bars[longest].death << ") walks";
  const ph::Index start = neighbours.begin()->first;
  ph::Index here = start;
  std::size_t steps = 0;
  do {
    std::cout << " " << here;
    const auto edge = neighbours.find(here);
    const ph::Index next = edge->second;
    neighbours.erase(edge);
    auto back = neighbours.find(next);
    while (back->second != here) ++back;
    neighbours.erase(back);
    here = next;
    ++steps;
  } while (here != start);
  std::cout << "\n" << steps << " of " << cycle.size() << " edges\n";
}
