// SPDX-License-Identifier: MIT
// Edges on their way into a complex: they are collected, sorted into bins, and stored as lists of
// neighbours.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "libph/src/rips/sweep/neighbour_lists.hpp"
#include "ph/detail/rips/binned_edges.hpp"
#include "ph/persistence.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/known_spaces.hpp"

namespace ph::test {
namespace {

using EdgeTuple = std::tuple<double, std::uint32_t, std::uint32_t>;

std::vector<EdgeTuple> tuples_of(std::span<const FlagEdge> edges) {
  std::vector<EdgeTuple> result;
  for (const FlagEdge& e : edges) result.emplace_back(e.value, e.u, e.v);
  return result;
}

// Edges with values from denormal to huge. About one value in ten is one of five values, which
// occur many times.
std::vector<FlagEdge> random_edges(std::size_t count) {
  std::mt19937_64 random(count);
  std::vector<FlagEdge> edges;
  for (std::size_t k = 0; k < count; ++k) {
    const auto u = static_cast<std::uint32_t>(1 + random() % 5000);
    const auto v = static_cast<std::uint32_t>(random() % u);
    const double spread =
        std::ldexp(static_cast<double>(random() % 1000), static_cast<int>(random() % 40) - 20);
    const double values[] = {0, 1, 2, std::numeric_limits<double>::denorm_min(),
                             std::numeric_limits<double>::max()};
    edges.push_back({random() % 10 == 0 ? values[random() % 5] : spread, u, v});
  }
  return edges;
}

TEST(EdgeLists, CollectedEdgesAreSortedInPlace) {
  for (const std::size_t count : {0, 1, 2, 1023, 1024, 1025, 5000, 300'000}) {
    const std::vector<FlagEdge> edges = random_edges(count);
    EdgeCollector collector(default_context());
    for (const FlagEdge& e : edges) collector.add(e);
    FlagEdges collected = collector.finish();
    EXPECT_EQ(tuples_of(collected), tuples_of(edges)) << count;
    const BinnedEdges binned = bin_edges(std::move(collected), default_context());
    std::vector<EdgeTuple> expected = tuples_of(edges);
    std::ranges::sort(expected);
    for (std::size_t bin = 0; bin < binned.bin_count(); ++bin)
      EXPECT_LT(binned.bin_begin(bin), binned.bin_begin(bin + 1)) << "an empty bin";
    EXPECT_EQ(tuples_of(binned.sorted()), expected) << count;
  }
}

TEST(EdgeLists, BinnerKeepsWhatIsWithinTheLimit) {
  constexpr double most = std::numeric_limits<double>::max();
  for (const std::size_t count : {0, 1, 100, 100'000})
    for (const std::size_t workers : {1, 3})
      for (const double limit : {0.0, 1.0, 1000.0, most}) {
        const std::vector<FlagEdge> edges = random_edges(count);
        EdgeBinner binner(count, workers, default_context());
        for (std::size_t k = 0; k < count; ++k) binner.count(edges[k].value, k % workers);
        binner.allocate(limit);
        std::vector<EdgeTuple> expected;
        for (std::size_t k = 0; k < count; ++k) {
          if (edges[k].value > limit) continue;
          binner.add(edges[k], k % workers);
          expected.emplace_back(edges[k].value, edges[k].u, edges[k].v);
        }
        std::ranges::sort(expected);
        EXPECT_EQ(tuples_of(binner.finish().sorted()), expected) << count << ", limit " << limit;
      }
}

TEST(EdgeLists, NeighboursAscendWhileTheGraphGrows) {
  constexpr std::uint32_t vertices = 60;
  std::vector<FlagEdge> edges;
  for (std::uint32_t u = 0; u < vertices; ++u)
    for (std::uint32_t v = 0; v < u; ++v)
      if ((u * v) % 3 != 1) edges.push_back({0.0, u, v});
  std::ranges::shuffle(edges, std::mt19937(7));
  FlagEdges copy(edges.begin(), edges.end(), std::pmr::get_default_resource());
  const BinnedEdges binned = bin_edges(std::move(copy), default_context());
  NeighbourLists<std::uint16_t> lists(vertices, binned, std::pmr::get_default_resource());
  std::vector<std::set<std::uint16_t>> expected(vertices);
  for (const FlagEdge& e : edges) {
    lists.add(e);
    expected[e.u].insert(static_cast<std::uint16_t>(e.v));
    expected[e.v].insert(static_cast<std::uint16_t>(e.u));
    for (const std::uint32_t w : {e.u, e.v}) EXPECT_TRUE(std::ranges::equal(lists[w], expected[w]));
  }
}

// There are more vertices than 16-bit numbers can count. They form a ring with two chords, which
// divide it into three parts.
TEST(EdgeLists, LinkOfMoreVerticesThanShortNumbers) {
  constexpr Index n = 66'000, far = n / 3;
  std::vector<WeightedEdge> edges;
  for (Index i = 0; i < n; ++i) {
    edges.push_back({i, (i + 1) % n, 1.0});
    edges.push_back({i, (i + 2) % n, 2.0});
  }
  edges.push_back({0, far, 3.0});
  edges.push_back({far, 2 * far, 3.5});
  edges.push_back({1, far, 4.0});  // forms a link with the first chord
  const Rips rips(SparseDistances(n, edges));
  const auto loops = [&](Engine engine) {
    std::vector<Bar> found = bars_of(persistence(rips, {.max_dim = 1, .engine = engine}));
    std::erase_if(found, [](const Bar& bar) { return bar.dim != 1; });
    return found;
  };
  const std::vector<Bar> expected{{1, 1.0, kInfinity}, {1, 3.0, kInfinity}, {1, 3.5, kInfinity}};
  EXPECT_EQ(loops(Engine::edge_links), expected);
  EXPECT_EQ(loops(Engine::cohomology), expected);
}

// A few vertices are joined to nearly all others. Their long lists are searched instead of scanned.
TEST(EdgeLists, OfHubsHaveTheBarsOfAnotherEngine) {
  constexpr std::uint32_t vertices = 1000, hubs = 2;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    // Values are either small integers, with many ties, or have nearly no ties.
    const double most = seed % 2 == 0 ? 5 : 1e9;
    const auto value = [&] {
      return std::ceil(most * static_cast<double>(random() % 1000) / 1000);
    };
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t hub = 0; hub < hubs; ++hub)
      for (std::uint32_t v = hub + 1; v < vertices; ++v)
        if (random() % 20 != 0) pairs.emplace(hub, v);
    for (int k = 0; k < 300; ++k) {
      const auto v = static_cast<std::uint32_t>(1 + random() % (vertices - 1));
      pairs.emplace(static_cast<std::uint32_t>(random() % v), v);
    }
    std::vector<WeightedEdge> edges;
    for (const auto& [u, v] : pairs) edges.push_back({u, v, value()});
    const Rips complex(SparseDistances(vertices, edges));
    for (const std::int64_t field : {2, 3}) {
      Options options{.max_dim = 2, .field = field, .engine = Engine::edge_links};
      const auto found = pairs_of(persistence(complex, options));
      options.engine = Engine::cohomology;
      EXPECT_EQ(found, pairs_of(persistence(complex, options)));
      EXPECT_GT(found.size(), 1000U);
    }
  }
}

}  // namespace
}  // namespace ph::test
