// SPDX-License-Identifier: MIT
// Cofacets in Rips complexes that are larger than the complexes of the conformance suite. There are
// several blocks of vertices, and there are columns whose limit rises many times.
#include <map>
#include <set>

#include "ph/persistence.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/generators.hpp"

namespace ph::test {
namespace {

using Key = RipsGraph::Key;

// The cofacets of a simplex, found by checking every vertex and every edge.
std::map<std::vector<Index>, Key> cofacets_of(const std::vector<Index>& simplex, Index size,
                                              const std::map<std::set<Index>, Key>& key_of) {
  std::map<std::vector<Index>, Key> cofacets;
  for (Index w = 0; w < size; ++w) {
    std::vector<Index> cofacet = simplex;
    cofacet.push_back(w);
    std::sort(cofacet.begin(), cofacet.end());
    Key key = 0;
    bool is_clique = std::adjacent_find(cofacet.begin(), cofacet.end()) == cofacet.end();
    for (std::size_t i = 0; is_clique && i < cofacet.size(); ++i) {
      for (std::size_t j = 0; is_clique && j < i; ++j) {
        const auto edge = key_of.find({cofacet[i], cofacet[j]});
        is_clique = edge != key_of.end();
        if (is_clique) key = std::max(key, edge->second);
      }
    }
    if (is_clique) cofacets.emplace(cofacet, key);
  }
  return cofacets;
}

template <class F>
void expect_cofacets(const F& f, const Rips& rips, Generator& random) {
  std::map<std::set<Index>, Key> key_of;
  for (Key key = 1; key <= all_edges(rips).edge_count(); ++key) {
    const FlagEdge& e = all_edges(rips).edge(key);
    key_of[{Index{e.u}, Index{e.v}}] = key;
  }
  const auto last_key = static_cast<int>(all_edges(rips).edge_count());
  for (int dim = 0; dim <= (rips.size() < 20 ? 7 : 2); ++dim) {
    int number = 0;
    f.for_each_cell(dim, [&](const auto& cell) {
      if (number++ % (rips.size() > 20 && dim == 2 ? 499 : 7) != 0) return;
      std::vector<Index> simplex;
      f.append_input_cell(dim, cell, simplex);
      auto first = static_cast<Key>(random.integer(1, last_key));
      auto last = static_cast<Key>(random.integer(1, last_key));
      if (last < first) std::swap(first, last);
      auto expected = cofacets_of(simplex, rips.size(), key_of);
      std::erase_if(expected, [&](const auto& c) { return c.second < first || c.second > last; });
      std::map<std::vector<Index>, Key> found;
      f.for_each_cofacet_within(dim, cell, first, last, [&](const auto& cofacet, int) {
        std::vector<Index> vertices;
        f.append_input_cell(dim + 1, cofacet, vertices);
        std::sort(vertices.begin(), vertices.end());
        EXPECT_TRUE(found.emplace(vertices, f.key(cofacet)).second);
        return true;
      });
      ASSERT_EQ(found, expected);
    });
  }
}

TEST(RipsCofacets, AreThoseOfTheRange) {
  for (const Index size : {1, 12, 63, 64, 65, 128, 150}) {
    for (const double density : {0.1, 0.6, 1.0}) {
      SCOPED_TRACE(std::to_string(size) + " points, " + std::to_string(density));
      Generator random(static_cast<std::uint64_t>(size));
      const Rips rips(random.sparse(size, random.coin(), density));
      if (all_edges(rips).edge_count() == 0) continue;
      with_rips_filtration(all_edges(rips), size < 20 ? 7 : 2,
                           [&](const auto& f) { expect_cofacets(f, rips, random); });
    }
  }
}

// Both engines must find the same cells. The engine `twist` uses boundaries instead of
// coboundaries.
TEST(RipsCofacets, ColumnsWhoseLimitRisesOftenAreReduced) {
  for (const std::int64_t field : {2, 3}) {
    for (const bool ties : {false, true}) {
      Generator random(7);
      const Rips rips(random.distances(30, ties));
      const auto pairs = [&](Engine engine) {
        return pairs_of(persistence(
            rips, {.max_dim = 3, .field = field, .engine = engine, .collapse = Collapse::off}));
      };
      EXPECT_EQ(pairs(Engine::cohomology), pairs(Engine::twist));
    }
  }
}

}  // namespace
}  // namespace ph::test
