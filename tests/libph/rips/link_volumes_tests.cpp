// SPDX-License-Identifier: MIT
// H3 by edge links: compares the pairs with the oracle cell by cell, over several fields, with
// ties, and for both ways of storing the graph.
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/conformance.hpp"
#include "tests/support/edge_link_pairs.hpp"
#include "tests/support/for_each_seed.hpp"

namespace ph::test {
namespace {

/// Distances between points in random groups. All distances between different groups are short. The
/// joins of cycles in different groups are therefore cycles of H2, H3 and above.
DistanceMatrix joined_groups(Generator& random, std::vector<Index> sizes, bool ties) {
  std::vector<std::size_t> group;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    group.insert(group.end(), static_cast<std::size_t>(sizes[i]), i);
  // Distributes the groups among the vertices at random.
  for (std::size_t i = group.size(); i > 1; --i)
    std::swap(group[i - 1],
              group[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
  std::vector<double> lower;
  for (std::size_t i = 0; i < group.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const bool is_short = group[i] != group[j] || random.integer(0, 9) == 0;
      lower.push_back((ties ? random.integer(0, 3) : random.real()) + (is_short ? 0 : 2));
    }
  return DistanceMatrix(static_cast<Index>(group.size()), lower);
}

std::size_t count_of_h3(const std::vector<Pair>& pairs) {
  return static_cast<std::size_t>(
      std::ranges::count_if(pairs, [](const Pair& p) { return p.bar.dim == 3; }));
}

/// @return the number of classes of H3.
std::size_t check_volumes(const Rips& rips, std::int64_t field, Engine expected_by) {
  std::size_t count = 0;
  with_all_edges(rips, 3, [&](const auto& f) {
    const auto expected = of_positive_length(pairs_of(f, 3, field, expected_by));
    for (const LinkLayout layout : {LinkLayout::rows, LinkLayout::lists})
      EXPECT_EQ(pairs_of_edge_links(f, 3, field, {.layout = layout}, 0), expected);
    count = count_of_h3(expected);
  });
  return count;
}

TEST(LinkVolumes, OfJoins) {
  std::size_t count = 0;
  for_each_seed(8000, [&](Generator& random, bool ties, std::int64_t field) {
    std::vector<Index> sizes;
    switch (random.integer(0, 2)) {
      case 0:
        sizes = {random.integer(4, 6), random.integer(4, 6)};
        break;  // the join of two circles
      case 1:
        sizes = {random.integer(2, 4), random.integer(6, 8)};
        break;  // the join of points and a sphere
      default:
        sizes = {2, 2, random.integer(2, 3), random.integer(2, 3)};
    }
    RipsOptions options;
    if (random.coin()) options.threshold = 2.5 + random.real();
    const Rips rips(joined_groups(random, sizes, ties), options);
    count += check_volumes(rips, field, Engine::standard);
  });
  EXPECT_TRUE(is_enough(count, std::size_t{2000})) << count;  // the test covers enough cases
}

TEST(LinkVolumes, OfAnyMatrix) {
  std::size_t count = 0;
  for_each_seed(2400, [&](Generator& random, bool ties, std::int64_t field) {
    const Index n = random.integer(8, 14);
    const Rips rips = random.coin() ? Rips(random.distances(n, ties))
                                    : Rips(random.sparse(n, ties, 0.5 + random.real() / 2));
    count += check_volumes(rips, field, Engine::standard);
  });
  EXPECT_TRUE(is_enough(count, std::size_t{150})) << count;
}

// Many classes are alive at the same time, no vertex of a link is joined to nearly all others, and
// rows have more than one word.
TEST(LinkVolumes, OfManyClasses) {
  std::size_t count = 0;
  for_each_seed(24, [&](Generator& random, bool ties, std::int64_t field) {
    const Rips rips(random.distances(random.integer(30, 42), ties));
    count += check_volumes(rips, field, Engine::cohomology);
    const std::vector<Index> wide = {random.integer(30, 36), random.integer(30, 36)};
    count += check_volumes(Rips(joined_groups(random, wide, ties), {.threshold = 2.2}), field,
                           Engine::cohomology);
  });
  EXPECT_TRUE(is_enough(count, std::size_t{1000})) << count;
}

// A sphere of dimension 3. Its only long class is still alive when there are many tetrahedra.
TEST(LinkVolumes, OfASphere) {
  Generator random(3);
  Points points(60, 4);
  for (Index i = 0; i < points.rows(); ++i) {
    double square = 0;
    for (Index k = 0; k < 4; ++k) square += std::pow(points(i, k) = random.real() - 0.5, 2);
    for (Index k = 0; k < 4; ++k) points(i, k) /= std::sqrt(square);
  }
  for (const std::int64_t field : {2, 3})
    EXPECT_GT(check_volumes(Rips(points), field, Engine::cohomology), 0U);
}

}  // namespace
}  // namespace ph::test
