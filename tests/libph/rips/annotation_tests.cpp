// SPDX-License-Identifier: MIT
// Tests the data structures in which the sweep of edge links stores classes of edges.
#include <array>
#include <initializer_list>
#include <map>
#include <memory_resource>
#include <set>
#include <utility>
#include <vector>

#include "libph/src/rips/annotations/dead_generators.hpp"
#include "libph/src/rips/annotations/number_set.hpp"
#include "libph/src/rips/sweep/active_edges.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

std::vector<std::uint32_t> numbers_of(const NumberSet& set) {
  std::vector<std::uint32_t> numbers;
  set.for_each([&](std::uint32_t id) { numbers.push_back(id); });
  std::ranges::sort(numbers);
  return numbers;
}

// Compares with std::set. Small sets are stored as lists, and large sets as rows of bits. Each kind
// is added to the other.
TEST(NumberSet, IsASet) {
  for_each_seed(300, [](Generator& random, bool, std::int64_t) {
    std::pmr::memory_resource* memory = std::pmr::get_default_resource();
    const auto size = random.integer(1, random.coin() ? 60 : 300);
    std::vector<NumberSet> sets;
    for (int k = 0; k < 3; ++k) sets.emplace_back(memory);
    std::array<std::set<std::uint32_t>, 3> expected;
    for (int step = 0; step < 4 * size; ++step) {
      const auto k = static_cast<std::size_t>(random.integer(0, 2));
      if (random.integer(0, 99) == 0) {
        const std::size_t other = (k + 1) % 3;
        sets[k].add(sets[other]);
        for (const std::uint32_t id : expected[other])
          if (expected[k].erase(id) == 0) expected[k].insert(id);
        continue;
      }
      const auto id = static_cast<std::uint32_t>(random.integer(0, size));
      EXPECT_EQ(sets[k].has(id), expected[k].contains(id));
      if (expected[k].insert(id).second) {
        sets[k].insert(id);
      } else if (random.coin()) {
        expected[k].erase(id);
        sets[k].erase(id);
      }
    }
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(numbers_of(sets[k]), std::vector(expected[k].begin(), expected[k].end()));
  });
}

TEST(ActiveEdges, AreAMap) {
  for_each_seed(100, [](Generator& random, bool, std::int64_t) {
    const int n = random.integer(2, 90);  // with up to 90 vertices, lists are searched in blocks
    ActiveEdges edges(static_cast<std::size_t>(n), random.coin(), std::pmr::get_default_resource());
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> labels;
    std::set<std::pair<std::uint32_t, std::uint32_t>> gone;
    for (std::uint32_t step = 0; step < 2000; ++step) {
      const auto u = static_cast<std::uint32_t>(random.integer(1, n - 1));
      const auto v = static_cast<std::uint32_t>(random.integer(0, static_cast<int>(u) - 1));
      if (labels.contains({u, v})) {
        EXPECT_EQ(*edges.find(u, v), labels.at({u, v}));
        EXPECT_EQ(*edges.find(v, u), labels.at({v, u}));
        if (random.integer(0, 3) != 0) continue;
        edges.erase(u, v);
        labels.erase({u, v});
        labels.erase({v, u});
        gone.insert({u, v});
      } else {
        EXPECT_EQ(edges.find(u, v), nullptr);
        if (gone.contains({u, v})) continue;
        edges.insert(u, v, 2 * step, 2 * step + 1);
        labels[{u, v}] = 2 * step;
        labels[{v, u}] = 2 * step + 1;
      }
    }
    std::size_t ends = 0;
    for (std::uint32_t v = 0; v < edges.vertex_count(); ++v) {
      std::vector<std::size_t> neighbours;
      if (edges.has_rows())
        bits::for_each(edges.row(v), 0, edges.words(),
                       [&](std::size_t w) { neighbours.push_back(w); });
      else
        neighbours.assign(edges.neighbours(v).begin(), edges.neighbours(v).end());
      for (const std::size_t w : neighbours)
        EXPECT_TRUE(labels.contains({v, static_cast<std::uint32_t>(w)}));
      EXPECT_EQ(edges.degree(v), neighbours.size());
      ends += neighbours.size();
    }
    EXPECT_EQ(ends, labels.size());
  });
}

// Compares with simple vectors, all of which are updated at each death. Some vectors are read
// between deaths.
template <Field K>
void check_dead_generators(const K& field, Generator& random) {
  using Vector = typename DeadGenerators<K>::Vector;
  using Coefficients = std::vector<typename K::Element>;  // one coefficient per generator
  const auto count = static_cast<std::size_t>(random.integer(2, 300));
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
  DeadGenerators<K> dead(field, memory);
  const auto is_dead = [&](std::size_t g) { return dead.contains(static_cast<std::uint32_t>(g)); };
  // Relations with few terms are stored as lists. Over Z/2, relations with many terms are stored as
  // rows of bits.
  const int most = random.coin() ? 8 : 100;
  const auto random_vector = [&](bool of_the_living) {
    Coefficients v(count, field.from_int(0));
    const int last = static_cast<int>(count) - 1, first = random.coin() ? 0 : last / 2;
    for (int k = random.integer(1, most); k-- > 0;)
      v[static_cast<std::size_t>(random.integer(first, last))] =
          field.from_int(random.integer(-9, 9));
    for (std::size_t g = 0; g < count; ++g)
      if (of_the_living && is_dead(g)) v[g] = field.from_int(0);
    return v;
  };
  const auto terms_of = [&](const Coefficients& v) {
    Vector terms(memory);
    for (std::size_t g = 0; g < count; ++g)
      if (!field.is_zero(v[g])) terms.emplace_back(static_cast<std::uint32_t>(g), v[g]);
    return terms;
  };
  const auto coefficients_of = [&](const Vector& terms) {
    Coefficients v(count, field.from_int(0));
    for (const auto& t : terms) v[t.cell] = t.coefficient();
    return v;
  };
  // The current vector, and its expected coefficients.
  std::vector<std::pair<Vector, Coefficients>> vectors;
  for (int k = 0; k < 20; ++k) {
    const Coefficients v = random_vector(false);
    vectors.emplace_back(terms_of(v), v);
  }
  for (std::size_t step = 0; step < 2 * count; ++step) {
    const Coefficients relation = random_vector(true);
    Vector terms = terms_of(relation);
    if (terms.empty()) continue;
    const std::size_t g = terms.back().cell;
    const auto unit = field.inverse(relation[g]);
    for (auto& [lazy, eager] : vectors) {
      const auto scale = field.negate(field.multiply(eager[g], unit));
      for (std::size_t k = 0; k < count; ++k)
        eager[k] = field.add(eager[k], field.multiply(scale, relation[k]));
    }
    dead.add(terms);
    EXPECT_TRUE(is_dead(g));
    auto& [lazy, eager] = vectors[random.integer(0, static_cast<int>(vectors.size()) - 1)];
    dead.eliminate_from(lazy);
    EXPECT_EQ(coefficients_of(lazy), eager);
    EXPECT_FALSE(dead.occur_in(lazy));
  }
  for (auto& [lazy, eager] : vectors) {
    dead.eliminate_from(lazy);
    EXPECT_EQ(coefficients_of(lazy), eager);
  }
}

TEST(DeadGenerators, AreEliminatedWhenLookedAt) {
  for_each_seed(100, [](Generator& random, bool, std::int64_t) {
    check_dead_generators(Z2{}, random);
    for (const std::uint32_t p : {3U, 5U, 32003U}) check_dead_generators(Zp(p), random);
  });
}

}  // namespace
}  // namespace ph::test
