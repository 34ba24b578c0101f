// SPDX-License-Identifier: MIT
// Tests the contents of the arrays in a report: normals, trees and their leaves, sets of voxels.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "libreport/report/arrays/point_arrays.hpp"
#include "libreport/report/arrays/tree_arrays.hpp"
#include "libreport/report/arrays/voxel_arrays.hpp"

namespace ph::report {
namespace {

TEST(Normals, AreFoundAgain) {
  const auto direction = [](std::array<std::int8_t, 2> stored) {
    const double u = stored[0] / 127.0, v = stored[1] / 127.0;
    std::array<double, 3> n{u, v, 1 - std::abs(u) - std::abs(v)};
    if (n[2] < 0) {
      n[0] = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
      n[1] = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
    }
    const double length = std::hypot(n[0], n[1], n[2]);
    for (double& x : n) x /= length;
    return n;
  };
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    std::array<double, 3> n{normal(random), normal(random), normal(random)};
    const double length = std::hypot(n[0], n[1], n[2]);
    for (double& x : n) x /= length;
    const auto m = direction(octahedral(n[0], n[1], n[2]));
    EXPECT_GT(n[0] * m[0] + n[1] * m[1] + n[2] * m[2], std::cos(std::numbers::pi / 180));
  }
  EXPECT_EQ(octahedral(0, 0, -1), (std::array<std::int8_t, 2>{127, 127}));
  EXPECT_EQ(octahedral(std::nan(""), 0, 1), (std::array<std::int8_t, 2>{-128, -128}));
}

/// The tree of a path of vertices with these births. Each edge enters with its later endpoint.
MergeTree path_tree(std::vector<double> births) {
  MergeTree tree;
  tree.births = std::move(births);
  const Index n = tree.size();
  std::vector<Index> oldest(tree.births.size()), sizes(tree.births.size(), 1);
  for (std::size_t v = 0; v < oldest.size(); ++v) oldest[v] = static_cast<Index>(v);
  std::vector<Index> edges;
  for (Index v = 0; v + 1 < n; ++v) edges.push_back(v);
  const auto birth = [&](Index v) { return tree.births[static_cast<std::size_t>(v)]; };
  const auto value = [&](Index e) { return std::max(birth(e), birth(e + 1)); };
  std::ranges::stable_sort(edges, {}, value);
  const auto root = [&](Index v) {
    while (oldest[static_cast<std::size_t>(v)] != v) v = oldest[static_cast<std::size_t>(v)];
    return v;
  };
  for (const Index e : edges) {
    Index elder = root(e), younger = root(e + 1);
    if (std::pair(birth(younger), younger) < std::pair(birth(elder), elder))
      std::swap(elder, younger);
    Index &large = sizes[static_cast<std::size_t>(elder)],
          small = sizes[static_cast<std::size_t>(younger)];
    tree.merges.push_back(
        {value(e), e, e + 1, elder, younger, large, small, birth(elder), birth(younger)});
    large += small;
    oldest[static_cast<std::size_t>(younger)] = elder;
  }
  return tree;
}

/// The partition that the page computes for a cut. Each vertex gets the smallest leaf of its
/// segment.
std::vector<std::uint32_t> page_cut(const MergeTree& tree, const ContractedTree& contracted,
                                    CutRule rule, double cut) {
  std::vector<std::uint32_t> parent(contracted.leaf_birth.size());
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto find = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i];
    return i;
  };
  for (const auto& k : contracted.merges) {
    const Merge& m = tree.merges[k.merge];
    const bool done = rule == CutRule::value ? m.value <= cut : m.persistence() < cut;
    const auto [low, high] = std::minmax({find(k.younger), find(k.elder)});
    if (done) parent[high] = low;
  }
  std::vector<std::uint32_t> part;
  for (std::size_t v = 0; v < tree.births.size(); ++v) part.push_back(find(contracted.leaf_of[v]));
  return part;
}

template <class A, class B>
void expect_same_partition(const std::vector<A>& a, const std::vector<B>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) ASSERT_EQ(a[i] == a[j], b[i] == b[j]) << i << " " << j;
}

TEST(Trees, CutAsTheProgramsDo) {
  std::mt19937 random(5);
  for (int round = 0; round < 20; ++round) {
    std::vector<double> births;
    for (int v = 0; v < 60; ++v) births.push_back(static_cast<double>(random() % 12));
    const MergeTree tree = path_tree(births);
    for (const Index min_part : {1, 4}) {
      const auto contraction =
          contracted(tree, CutRule::persistence, 1, min_part, {}, default_context());
      for (const double cut : {1.0, 2.0, 5.0, 100.0})
        expect_same_partition(page_cut(tree, contraction, CutRule::persistence, cut),
                              tree.basins(cut, min_part));
    }
    const auto contraction = contracted(tree, CutRule::value, 2, 1, {}, default_context());
    for (const double cut : {11.0, 12.0})  // at these values, all vertices have entered
      expect_same_partition(page_cut(tree, contraction, CutRule::value, cut), tree.components(cut));
  }
}

TEST(Trees, LeavesAreNumberedByTheirSmallestVertexAndEndsByAge) {
  const MergeTree tree = path_tree({5, 0, 7, 2, 9, 4, kInfinity});
  MergeTree some = tree;
  std::erase_if(some.merges, [](const Merge& m) { return m.value == kInfinity; });
  const auto c = contracted(some, CutRule::persistence, 1, 1, {}, default_context());
  EXPECT_EQ(c.leaf_of, (std::vector<std::uint32_t>{0, 0, 0, 1, 1, 2, kNone}));
  EXPECT_EQ(c.leaf_birth, (std::vector<double>{0, 2, 4}));
  EXPECT_EQ(c.leaf_vertices, (std::vector<std::uint32_t>{3, 2, 1}));
  ASSERT_EQ(c.merges.size(), 2U);
  EXPECT_EQ(c.merges[0].younger, 1U);
  EXPECT_EQ(c.merges[0].elder, 0U);
  EXPECT_EQ(c.merges[1].younger, 2U);
  EXPECT_EQ(c.merges[1].elder, 1U);
}

TEST(Trees, BarsAreLinkedByValueAndThenByVertex) {
  const MergeTree tree = path_tree({0, 9, 1, 9, 1, 9, 0});
  Barcode bars;
  bars.add({0, 0, 9}, {}, {});
  bars.add({0, 0, kInfinity}, {}, {});
  bars.add({0, 1, 9}, {}, {});
  bars.add({0, 1, 9}, {}, {});
  const std::vector<std::uint32_t> vertices{6, 0, 4, 2};
  const LinkedBars linked = linked_bars(tree, bars, vertices);
  EXPECT_EQ(linked.of_vertex[0], 1U);
  for (std::size_t i = 0; i < tree.merges.size(); ++i) {
    const Merge& m = tree.merges[i];
    const std::uint32_t expected = m.persistence() == 0 ? kNone
                                   : m.younger == 6     ? 0U
                                   : m.younger == 4     ? 2U
                                                        : 3U;
    EXPECT_EQ(linked.of_merge[i], expected) << m.younger;
  }
}

TEST(Trees, TheLeastCutKeepsNoMoreThanAskedFor) {
  const MergeTree tree = path_tree({0, 9, 1, 9, 2, 9, 3, 9, 3});
  for (const CutRule rule : {CutRule::persistence, CutRule::value})
    for (const std::size_t most : {1, 2, 3, 4, 100}) {
      const double from = least_cut(tree, rule, most);
      EXPECT_LE(contracted(tree, rule, from, 1, {}, default_context()).merges.size(),
                std::max<std::size_t>(most, 2))
          << most;
    }
  EXPECT_EQ(least_cut(tree, CutRule::persistence, 100), 6);
  EXPECT_EQ(least_cut({}, CutRule::value, 1), 0);
  // All cuts on a page are finite.
  const MergeTree infinite = path_tree({-kInfinity, 3, -kInfinity, 5, 1});
  EXPECT_EQ(least_cut(infinite, CutRule::persistence, 100), 4);
  EXPECT_EQ(least_cut(path_tree({-kInfinity, 3, -kInfinity}), CutRule::persistence, 100), 1);
}

TEST(TouchingLeaves, AreBesideEachOtherInThePicture) {
  constexpr std::uint32_t none = kNone;
  // There are two rows of twelve pixels. Some pixels are missing, among them the first pixel of the
  // second row.
  const std::vector<std::uint32_t> index = {0,  1,  2,  3,  11, 13, 14, 15,
                                            16, 17, 18, 19, 20, 21, 22, 23};
  const std::vector<std::uint32_t> leaf = {5,    5,    none, 1,    2,    5,    none, none,
                                           none, none, none, none, none, none, 7,    2};
  // Leaves 1 and 2 are eight columns apart, and leaves 5 and 7 are nine columns apart. Leaves 2 and
  // 7 are neighbours. Leaf 1 has no neighbour in the row below.
  EXPECT_EQ(touching_in_picture(index, leaf, 12), (std::vector<std::uint32_t>{1, 2, 1, 5, 2, 7}));
  // The last pixel of a row does not touch the first pixel of the next row.
  const std::vector<std::uint32_t> ends = {11, 12}, two = {0, 1};
  EXPECT_TRUE(touching_in_picture(ends, two, 12).empty());
  const std::vector<std::uint32_t> rows = {0, 24, 25};
  EXPECT_EQ(touching_in_picture(rows, std::vector<std::uint32_t>{3, 4, none}, 3),
            (std::vector<std::uint32_t>{3, 4}));
  EXPECT_TRUE(touching_in_picture(rows, std::vector<std::uint32_t>{3, 4, none}, 2).empty());
}

/// Bars of H0, each given by its birth and the voxels of its set.
Barcode with_sets(const std::vector<std::pair<double, std::vector<std::uint32_t>>>& bars) {
  Barcode barcode(CellKind::grid);
  for (const auto& [birth, places] : bars) {
    const Index cell[] = {0, 0};
    barcode.add({0, birth, 10}, cell, cell);
    barcode.set_representative(Representatives::voxels, {}, {});
    const std::size_t begin = barcode.store_voxels(places);
    barcode.set_voxels({begin, begin + places.size()}, cell, cell);
  }
  return barcode;
}

using Places = std::vector<std::uint32_t>;

TEST(VoxelSets, AreRunsTheMostPersistentFirst) {
  const VoxelSets sets =
      voxel_sets(with_sets({{5, {9, 7, 8, 3}}, {1, {0}}, {2, {}}, {3, {70'000, 2, 1}}}), {});
  EXPECT_EQ(sets.bars, (Places{1, 3, 0}));
  EXPECT_EQ(sets.start, (Places{0, 1, 3, 5}));
  EXPECT_EQ(sets.runs, (Places{0, 1, 1, 2, 70'000, 1, 3, 1, 7, 3}));
  EXPECT_EQ(sets.note(), "");
}

TEST(VoxelSets, ThatExceedTheBudgetAreLeftOutAndCounted) {
  const Barcode barcode = with_sets({{1, {0, 2, 4, 6}}, {2, {1, 2, 3}}, {3, {0, 2}}, {4, {5}}});
  const VoxelSets few_runs = voxel_sets(barcode, {}, {.runs = 3});
  EXPECT_EQ(few_runs.bars, (Places{1, 2}));
  EXPECT_EQ(few_runs.start, (Places{0, 1, 3}));
  EXPECT_EQ(few_runs.runs, (Places{1, 3, 0, 1, 2, 1}));
  EXPECT_EQ(few_runs.left_out, 2U);
  EXPECT_NE(few_runs.note().find("the 2 most persistent of 4 bars"), std::string::npos);
  const VoxelSets few_voxels = voxel_sets(barcode, {}, {.voxels = 6});
  EXPECT_EQ(few_voxels.bars, (Places{0, 2}));
  EXPECT_EQ(few_voxels.left_out, 2U);
}

TEST(VoxelSets, AreThoseOfABarcodeThatHasThem) {
  Barcode cycles;
  const Index cell[] = {0};
  cycles.add({0, 0, 1}, cell, cell);
  EXPECT_TRUE(voxel_sets(cycles, {}).bars.empty());
}

}  // namespace
}  // namespace ph::report
