// SPDX-License-Identifier: MIT
#include "libsegment/src/objects/weak_seams.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <stop_token>
#include <utility>
#include <vector>

#include "ph/error.hpp"
#include "tests/support/expect_error.hpp"

namespace ph::segment {
namespace {

constexpr double kRadius = 1;

/// The voxels of a scene with their basins and births, and the pairs of voxels that are close to
/// each other.
struct Basins {
  std::vector<Index> of;
  std::vector<double> births;
  std::vector<VoxelPair> pairs;

  std::vector<Index> joined(double least, const RunContext& context = default_context()) const {
    return join_over_weak_seams(of, births, pairs, kRadius, least, context);
  }
  /// The joined basins by the definition: after each removal of a seam, all seams are examined
  /// again.
  std::vector<Index> joined_slowly(double least) const {
    std::vector<Index> basin_of = of;
    while (true) {
      std::map<std::pair<Index, Index>, std::vector<double>> seams;
      for (const VoxelPair& p : pairs)
        if (p.distance < kRadius && basin_of[p.u] != basin_of[p.v])
          seams[std::minmax(basin_of[p.u], basin_of[p.v])].push_back(
              std::max(births[p.u], births[p.v]));
      std::optional<std::pair<Index, Index>> weakest;
      double strength = least;
      for (auto& [both, values] : seams) {
        std::ranges::sort(values);
        if (const double quartile = values[values.size() / 4]; quartile < strength) {
          strength = quartile;
          weakest = both;
        }
      }
      if (!weakest) return basin_of;
      std::ranges::replace(basin_of, weakest->second, weakest->first);
    }
  }
  /// Adds basins of one voxel each, with these births.
  void add_basins(const std::vector<double>& its_births) {
    for (const double birth : its_births) {
      of.push_back(std::ssize(of));
      births.push_back(birth);
    }
  }
  /// Adds a seam between two basins: for each of these values, a pair of new voxels at this value.
  void add_seam(Index a, Index b, const std::vector<double>& values) {
    for (const double value : values) {
      const auto u = static_cast<std::uint32_t>(of.size());
      of.insert(of.end(), {a, b});
      births.insert(births.end(), {0, value});
      pairs.push_back({u, u + 1, 0.5F});
    }
  }
  std::size_t left(double least) const {
    const std::vector<Index> basin_of = joined(least);
    return std::set(basin_of.begin(), basin_of.end()).size();
  }
};

TEST(WeakSeams, AreJudgedByTheirLowerQuartile) {
  Basins basins;
  basins.add_basins({0, 0});
  basins.add_seam(0, 1, {9, 1, 9, 3, 5, 9, 9, 9});  // sorted: 1, 3, 5, …
  EXPECT_EQ(basins.left(5), 2U) << "a seam of that strength stays";
  EXPECT_EQ(basins.left(5.01), 1U);
  basins.pairs.push_back({0, 1, 1.5F});  // not adjacent, and thus not a part of the seam
  EXPECT_EQ(basins.left(5), 2U);
}

TEST(WeakSeams, GrowTogetherWhenBasinsDo) {
  // Basins 0 and 1 become one basin. Basin 2 then has a seam with the joined basin, and the weak
  // place next to basin 1 is only a short piece of the seam.
  Basins basins;
  basins.add_basins({0, 0, 0});
  basins.add_seam(0, 1, {1, 1, 1});
  basins.add_seam(1, 2, {3});
  basins.add_seam(0, 2, {8, 8, 8, 8, 8});
  EXPECT_EQ(basins.left(3), 2U);
  EXPECT_EQ(basins.left(4), 2U) << "the weakest goes first, and the other is strong by then";
  EXPECT_EQ(basins.left(9), 1U);
}

TEST(WeakSeams, ThatAreNoneJoinNothing) {
  Basins basins;
  EXPECT_TRUE(basins.joined(kInfinity).empty());
  basins.add_basins({0, 0});
  EXPECT_EQ(basins.left(kInfinity), 2U) << "they do not touch";
  basins.add_seam(0, 1, {0});
  EXPECT_EQ(basins.left(0), 2U) << "no seam is weaker than nothing";
}

TEST(WeakSeams, TheSmallerNumberStays) {
  Basins basins;
  basins.add_basins({0, 0, 0, 0});
  basins.add_seam(2, 3, {1});
  basins.add_seam(1, 2, {2});
  basins.add_seam(0, 1, {3});
  const std::vector<Index> of_all = basins.joined(10);
  EXPECT_EQ(of_all, std::vector<Index>(of_all.size(), 0));
  const std::vector<Index> of_some = basins.joined(3);
  EXPECT_EQ(std::vector<Index>(of_some.begin(), of_some.begin() + 4),
            (std::vector<Index>{0, 1, 1, 1}));
}

TEST(WeakSeams, AreThoseOfASlowSearch) {
  std::mt19937 random(17);
  const auto any = [&](int below) {
    return std::uniform_int_distribution<int>(0, below - 1)(random);
  };
  std::size_t joins = 0, stayed = 0;
  for (int round = 0; round < 1500; ++round) {
    Basins basins;
    const int voxels = 2 + any(60), basin_count = 1 + any(20), levels = 1 + any(8);
    std::vector<Index> example(static_cast<std::size_t>(basin_count), -1);
    std::vector<std::size_t> number;
    for (int v = 0; v < voxels; ++v) {
      number.push_back(static_cast<std::size_t>(any(basin_count)));
      if (example[number.back()] < 0 || any(3) == 0) example[number.back()] = v;
      basins.births.push_back(any(levels));
    }
    for (const std::size_t b : number) basins.of.push_back(example[b]);
    for (int k = any(200); k > 0; --k) {
      const auto u = static_cast<std::uint32_t>(any(voxels)),
                 v = static_cast<std::uint32_t>(any(voxels));
      if (u != v)
        basins.pairs.push_back(
            {std::min(u, v), std::max(u, v), 0.25F * static_cast<float>(any(6))});
    }
    for (const double least : {1.0, 0.5 * levels, kInfinity}) {
      const std::vector<Index> found = basins.joined(least);
      ASSERT_EQ(found, basins.joined_slowly(least)) << "round " << round;
      const std::size_t left = std::set(found.begin(), found.end()).size();
      joins += std::set(basins.of.begin(), basins.of.end()).size() - left;
      stayed += left;
    }
  }
  EXPECT_GT(joins, 10000U);
  EXPECT_GT(stayed, 10000U);
}

TEST(WeakSeams, CanBeStopped) {
  Basins basins;
  basins.add_basins({0, 0});
  basins.add_seam(0, 1, {1});
  std::stop_source source;
  RunContext context;
  context.stop = source.get_token();
  EXPECT_EQ(basins.joined(2, context), basins.joined(2));
  source.request_stop();
  EXPECT_TRUE(ph::test::fails_with(ErrorKind::cancelled, [&] { basins.joined(2, context); }))
      << "not stopped";
}

}  // namespace
}  // namespace ph::segment
