// SPDX-License-Identifier: MIT
// Tests the data structures in which the sweep of edge links stores classes of edges if thousands
// of classes are alive.
#include <algorithm>
#include <array>
#include <map>
#include <memory_resource>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "libph/src/rips/relations/formal_sums.hpp"
#include "libph/src/rips/relations/pair_labels.hpp"
#include "libph/src/rips/relations/sum_rows.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

using Sum = std::set<std::uint32_t>;  // a set of generators

Sum operator+(const Sum& a, const Sum& b) {
  Sum sum;
  std::ranges::set_symmetric_difference(a, b, std::inserter(sum, sum.end()));
  return sum;
}

Sum random_sum(Generator& random, std::size_t generators, int most) {
  Sum sum;
  for (int k = random.integer(0, most); k-- > 0;)
    sum.insert(static_cast<std::uint32_t>(random.integer(0, static_cast<int>(generators) - 1)));
  return sum;
}

// The relations as columns. Each column is fully reduced by the columns before it.
class Oracle {
 public:
  std::optional<std::uint32_t> add(const Sum& relation) {
    const Sum rest = reduced(relation);
    if (rest.empty()) return std::nullopt;
    const std::uint32_t g = *rest.rbegin();
    for (auto& [dead, meaning] : meanings_)
      if (meaning.contains(g)) meaning = meaning + rest;
    meanings_[g] = rest + Sum{g};
    return g;
  }
  Sum reduced(const Sum& sum) const {
    Sum result;
    for (const std::uint32_t g : sum)
      result = result + (meanings_.contains(g) ? meanings_.at(g) : Sum{g});
    return result;
  }
  bool is_dead(std::uint32_t g) const { return meanings_.contains(g); }
  std::size_t dead_count() const { return meanings_.size(); }

 private:
  std::map<std::uint32_t, Sum> meanings_;
};

// Checks the result of `substitute`: a living generator stands for itself, and a dead generator for
// a sum of living generators.
template <class Relations>
void check_substitution(const Relations& relations, const Oracle& oracle, std::size_t generators,
                        auto&& substitute) {
  const std::size_t words = generators / 64 + 1;
  std::vector<bits::Word> vectors(generators * words, 0);
  for (std::uint32_t g = 0; g < generators; ++g) {
    ASSERT_EQ(relations.is_dead(g), oracle.is_dead(g));
    if (!oracle.is_dead(g)) vectors[g * words + g / 64] = bits::Word{1} << (g % 64);
  }
  substitute(vectors.data(), words);
  for (std::uint32_t g = 0; g < generators; ++g) {
    Sum meaning;
    bits::for_each(vectors.data() + g * words, 0, words,
                   [&](std::size_t h) { meaning.insert(static_cast<std::uint32_t>(h)); });
    EXPECT_EQ(meaning, oracle.reduced({g}));
  }
}

TEST(PairLabels, AreAMatrix) {
  for_each_seed(20, [](Generator& random, bool, std::int64_t) {
    const auto n = static_cast<std::uint32_t>(random.integer(2, 30));
    PairLabels labels(n, std::pmr::get_default_resource());
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> expected;
    for (int step = 0; step < 200; ++step) {
      const auto u = static_cast<std::uint32_t>(random.integer(0, static_cast<int>(n) - 1));
      const auto v = static_cast<std::uint32_t>(random.integer(0, static_cast<int>(n) - 1));
      EXPECT_EQ(labels(u, v), expected[std::minmax(u, v)]);
      const auto label = static_cast<std::uint32_t>(
          random.integer(0, 49) == 0 ? 65536 : random.integer(0, step < 100 ? 65535 : 1 << 20));
      labels.set(u, v, label);
      expected[std::minmax(u, v)] = label;
    }
    for (const auto& [pair, label] : expected) {
      EXPECT_EQ(labels(pair.first, pair.second), label);
      EXPECT_EQ(labels(pair.second, pair.first), label);
    }
  });
}

// The relations have few terms and are stored as lists, or many terms and are stored as rows of
// bits.
TEST(FormalSums, KillWhatColumnsKill) {
  std::size_t follow = 0;
  for_each_seed(50, [&](Generator& random, bool, std::int64_t) {
    const auto generators = static_cast<std::size_t>(random.integer(1, 300));
    FormalSums sums(std::pmr::get_default_resource());
    std::vector<Sum> expected{{}};
    const auto insert = [&](const Sum& sum) {
      const std::vector<std::uint32_t> terms(sum.begin(), sum.end());
      const FormalSums::Sum a = sums.insert(terms);
      if (sum.empty())
        EXPECT_EQ(a, 0U);
      else
        expected.push_back(sum);
    };
    Oracle oracle;
    const int most = random.coin() ? 3 : 60;
    for (std::size_t step = 0; step < 2 * generators; ++step) {
      insert(random_sum(random, generators, most));
      const auto any = [&] {
        return static_cast<FormalSums::Sum>(random.integer(0, static_cast<int>(sums.count()) - 1));
      };
      const FormalSums::Sum a = any(), b = any(), sum = sums.add(a, b);
      if (!(expected[a] + expected[b]).empty()) expected.push_back(expected[a] + expected[b]);
      EXPECT_TRUE(std::ranges::equal(sums[sum], expected[a] + expected[b]));
      EXPECT_EQ(sums.count(), expected.size());

      const FormalSums::Sum relation[] = {any(), any()};
      const auto killed = oracle.add(expected[relation[0]] + expected[relation[1]]);
      EXPECT_EQ(sums.add_relation(relation), killed.value_or(EchelonRelations::kNone));
      follow += killed ? 0 : 1;
      EXPECT_EQ(sums.relations().dead_count(), oracle.dead_count());
    }
    check_substitution(sums.relations(), oracle, generators, [&](auto* vectors, auto words) {
      sums.relations().substitute(vectors, generators, words);
    });
  });
  EXPECT_TRUE(is_enough(follow, std::size_t{500})) << follow;  // the test covers enough cases
}

// Generators are born between blocks of relations. There are so many generators that rows must
// grow.
TEST(SumRows, KillWhatColumnsKill) {
  for_each_seed(30, [](Generator& random, bool, std::int64_t) {
    auto generators = static_cast<std::size_t>(random.integer(1, 200));
    const std::size_t words = SumRows::words_for(generators);
    std::vector<Sum> expected{{}};
    const int most = random.coin() ? 3 : 60;
    for (int k = 0; k < 20; ++k) expected.push_back(random_sum(random, generators, most));
    std::pmr::vector<bits::Word> rows(expected.size() * words, 0);
    for (std::size_t a = 0; a < expected.size(); ++a)
      for (const std::uint32_t g : expected[a])
        rows[a * words + g / 64] |= bits::Word{1} << (g % 64);
    SumRows sums(generators, std::move(rows), std::pmr::get_default_resource());

    Oracle oracle;
    for (int block = random.integer(1, 5); block-- > 0;) {
      std::vector<std::optional<std::uint32_t>> killed;
      for (int step = random.integer(0, 1200); step-- > 0;) {
        const auto any = [&] {
          return static_cast<SumRows::Sum>(random.integer(0, static_cast<int>(sums.count()) - 1));
        };
        if (random.integer(0, 3) == 0) {
          sums.append_generator();
          expected.push_back({static_cast<std::uint32_t>(generators++)});
        }
        const SumRows::Sum a = any(), b = any(), sum = sums.add(a, b);
        const Sum both = expected[a] + expected[b];
        EXPECT_EQ(sum == 0, both.empty());
        if (!both.empty()) expected.push_back(both);
        ASSERT_EQ(sums.count(), expected.size());

        const std::array<SumRows::Sum, 4> relation{any(), any(), any(), any()};
        Sum total;
        for (const SumRows::Sum c : relation) total = total + expected[c];
        EXPECT_EQ(sums.add_relation(relation), !total.empty());
        if (!total.empty()) killed.push_back(oracle.add(total));
        ASSERT_EQ(sums.relation_count(), killed.size());
      }
      EXPECT_TRUE(std::ranges::equal(sums.solve(), killed, {}, {}, [](const auto& g) {
        return g.value_or(RelationMatrix::kNone);
      }));
      EXPECT_EQ(sums.matrix().living_count(), generators - oracle.dead_count());
    }
    for (SumRows::Sum a = 0; a < sums.count(); ++a) {
      Sum terms;
      bits::for_each(sums[a], 0, sums.words(),
                     [&](std::size_t g) { terms.insert(static_cast<std::uint32_t>(g)); });
      EXPECT_EQ(terms, expected[a]);
    }
    if (sums.matrix().row_count() == generators)
      check_substitution(sums.matrix(), oracle, generators, [&](auto* vectors, auto word_count) {
        sums.matrix().substitute(vectors, word_count);
      });
  });
}

}  // namespace
}  // namespace ph::test
