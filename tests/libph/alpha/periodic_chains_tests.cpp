// SPDX-License-Identifier: MIT
// Representatives in periodic spaces. They are checked with the vertices that users see and with
// the signs that these vertices define. The checks do not use the library's own incidences.
#include <gtest/gtest.h>

#include <map>

#include "ph/alpha.hpp"
#include "ph/persistence.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/points.hpp"

namespace ph::test {
namespace {

// The coefficient of each cell. The cell is identified by its ascending vertices.
using Chain = std::map<std::vector<Index>, std::int64_t>;

Chain facets_of(const std::vector<Index>& cell) {
  Chain facets;
  for (std::size_t k = 0; k < cell.size(); ++k) {
    std::vector<Index> facet = cell;
    facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(k));
    facets[facet] += k % 2 == 0 ? 1 : -1;
  }
  return facets;
}

Chain chain_of(const InputChain& chain) {
  Chain result;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const auto numbers = chain.cell(i).numbers;
    EXPECT_TRUE(std::ranges::is_sorted(numbers));
    result[{numbers.begin(), numbers.end()}] += chain.coefficient(i);
  }
  return result;
}

Alpha alpha_of(Generator& random, Index dim, int count) {
  Points points = random.points(count, dim, false);
  if (count > 1 && random.coin()) copy_point(points, 0, points, count - 1);
  return Alpha(points, {.period = std::vector<double>(static_cast<std::size_t>(dim), 1.5)});
}

// The representatives of the two loops are edges from the point to its own images.
TEST(PeriodicChains, OfOnePoint) {
  const Barcode bars = persistence(Alpha(Points{{0, 0}}, {.period = {2, 3}}),
                                   {.field = 3, .representatives = Representatives::cycles});
  ASSERT_EQ(bars.size(), 4U);
  for (const std::size_t i : {1, 2}) {
    const InputChain cycle = bars.representative(i);
    ASSERT_EQ(cycle.size(), 1U);
    EXPECT_TRUE(std::ranges::equal(cycle.cell(0).numbers, std::vector<Index>{0, 0}));
  }
  EXPECT_EQ(bars.representative(3).size(), 2U);  // both triangles of the torus
}

// Some clouds have so few points that different cells have the same vertices.
TEST(PeriodicChains, CyclesHaveNoBoundary) {
  for_each_seed(60, [](Generator& random, bool, std::int64_t field) {
    const Index dim = random.integer(1, 3);
    const Alpha alpha = alpha_of(random, dim, random.integer(1, 30));
    for (const Engine engine : {Engine::automatic, Engine::twist, Engine::cohomology}) {
      const Barcode bars = persistence(alpha, {.max_dim = 3,
                                               .field = field,
                                               .engine = engine,
                                               .representatives = Representatives::cycles});
      EXPECT_EQ(std::ranges::count_if(bars.bars(static_cast<int>(dim)), &Bar::is_infinite), 1);
      for (std::size_t i = 0; i < bars.size(); ++i) {
        if (bars[i].dim == 0) continue;
        Chain boundary;
        for (const auto& [cell, a] : chain_of(bars.representative(i)))
          for (const auto& [facet, sign] : facets_of(cell)) boundary[facet] += a * sign;
        for (const auto& [facet, a] : boundary)
          ASSERT_EQ(a % field, 0) << "bar " << i << " of H" << bars[i].dim;
      }
    }
  });
}

TEST(PeriodicChains, CocyclesHaveNoCoboundary) {
  int checked = 0;
  for_each_seed(40, [&](Generator& random, bool, std::int64_t field) {
    const Index dim = random.integer(1, 2);
    const Alpha alpha = alpha_of(random, dim, 30);
    std::map<std::vector<Index>, double> values;
    std::size_t count = 0;
    for (int k = 0; k <= alpha.top_dim(); ++k)
      alpha.for_each_cell(k, [&](const Alpha::Cell& cell) {
        std::vector<Index> numbers;
        alpha.append_input_cell(k, cell, numbers);
        values[numbers] = alpha.value(cell);
        ++count;
      });
    if (values.size() < count) return;  // different cells have the same vertices
    const Barcode bars = persistence(alpha, {.max_dim = 3,
                                             .field = field,
                                             .engine = Engine::cohomology,
                                             .representatives = Representatives::cocycles});
    for (std::size_t i = 0; i < bars.size(); ++i) {
      const Chain cochain = chain_of(bars.representative(i));
      for (const auto& [cell, value] : values) {
        if (cell.size() != static_cast<std::size_t>(bars[i].dim) + 2 || value >= bars[i].death)
          continue;
        std::int64_t coboundary = 0;
        for (const auto& [facet, sign] : facets_of(cell))
          if (const auto at = cochain.find(facet); at != cochain.end())
            coboundary += sign * at->second;
        ASSERT_EQ(coboundary % field, 0) << "bar " << i << " of H" << bars[i].dim;
        ++checked;
      }
    }
  });
  EXPECT_TRUE(is_enough(checked, 10'000)) << checked;
}

}  // namespace
}  // namespace ph::test
