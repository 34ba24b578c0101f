// SPDX-License-Identifier: MIT
// Compares method paper with an independent single linkage on real frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "ph/eigen.hpp"
#include "ph/segment.hpp"
#include "tests/support/test_data.hpp"

namespace ph::segment {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> scenes() {
  std::vector<fs::path> files;
  const fs::path folder = ph::test::test_data("scenes");
  if (folder.empty()) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".pcd") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

using Cell = std::array<long, 3>;  // z, y, x

struct Means {
  std::array<double, 3> sum{};
  double count = 0;
  std::vector<std::size_t> points;
};

/// For each voxel, the sum, the number and the indices of the points that the earlier stages leave,
/// computed from the definitions of the stages.
std::map<Cell, Means> voxels_of(const std::vector<float>& xyz, const Segmentation& s,
                                const SegmentOptions& o) {
  std::map<Cell, Means> voxels;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const double x = xyz[3 * i], y = xyz[3 * i + 1], z = xyz[3 * i + 2];
    if (!(std::sqrt(x * x + y * y + z * z) <= o.max_range)) continue;
    if (s.tree.plane && !(s.tree.plane->signed_distance(x, y, z) > o.plane_margin())) continue;
    Means& voxel = voxels[{std::lround(std::floor(z / o.voxel_size())),
                           std::lround(std::floor(y / o.voxel_size())),
                           std::lround(std::floor(x / o.voxel_size()))}];
    voxel.sum[0] += x, voxel.sum[1] += y, voxel.sum[2] += z;
    voxel.count += 1;
    voxel.points.push_back(i);
  }
  return voxels;
}

/// Single linkage by flood fill over all pairs, without a tree or disjoint sets.
std::vector<int> flood(const Points& vertices, double distance) {
  std::vector<int> component(static_cast<std::size_t>(vertices.rows()), -1);
  int count = 0;
  for (Index start = 0; start < vertices.rows(); ++start) {
    if (component[static_cast<std::size_t>(start)] >= 0) continue;
    std::vector<Index> open = {start};
    component[static_cast<std::size_t>(start)] = count;
    while (!open.empty()) {
      const Index v = open.back();
      open.pop_back();
      for (Index w = 0; w < vertices.rows(); ++w) {
        if (component[static_cast<std::size_t>(w)] >= 0) continue;
        if (std::abs(vertices(v, 2) - vertices(w, 2)) > distance) continue;
        if (!((as_matrix(vertices).row(v) - as_matrix(vertices).row(w)).norm() <= distance))
          continue;
        component[static_cast<std::size_t>(w)] = count;
        open.push_back(w);
      }
    }
    ++count;
  }
  return component;
}

class SceneTest : public testing::TestWithParam<double> {};

TEST_P(SceneTest, IsSingleLinkageOfTheVoxels) {
  const std::vector<fs::path> files = scenes();
  if (files.empty()) GTEST_SKIP() << ph::test::no_test_data("scenes");
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.filename());
    const std::vector<float> xyz = read_cloud(file).xyz();
    const SegmentOptions options{.method = Method::paper, .distance = GetParam()};
    const Segmentation s = segment(CloudView{xyz, {}}, options);
    EXPECT_TRUE(s.checked);
    EXPECT_EQ(s.difference, "");
    ASSERT_TRUE(s.tree.plane) << s.plane_note;

    const auto voxels = voxels_of(xyz, s, options);
    ASSERT_EQ(static_cast<std::size_t>(s.tree.vertices.rows()), voxels.size());
    std::vector<const Means*> in_order;
    for (const auto& [cell, voxel] : voxels) {
      const auto v = static_cast<Index>(in_order.size());
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_NEAR(s.tree.vertices(v, static_cast<Index>(k)), voxel.sum[k] / voxel.count, 1e-9);
      }
      in_order.push_back(&voxel);
    }

    const std::vector<int> component = flood(s.tree.vertices, options.distance);
    std::map<int, Index> sizes;
    for (const int c : component) ++sizes[c];
    std::map<int, std::set<std::uint32_t>> labels_of;
    std::vector<std::uint32_t> expected_zero(s.cut.labels.size(), 1);
    for (std::size_t v = 0; v < in_order.size(); ++v) {
      for (const std::size_t i : in_order[v]->points) {
        labels_of[component[v]].insert(s.cut.labels[i]);
        expected_zero[i] = 0;
      }
    }
    std::set<std::uint32_t> used;
    for (const auto& [c, labels] : labels_of) {
      ASSERT_EQ(labels.size(), 1U) << "component " << c << " has several labels";
      if (sizes[c] < options.cut().min_size) {
        EXPECT_EQ(*labels.begin(), 0U);
      } else {
        EXPECT_NE(*labels.begin(), 0U);
        EXPECT_TRUE(used.insert(*labels.begin()).second) << "two components, one label";
      }
    }
    EXPECT_EQ(used.size(), s.cut.segments.size());
    for (std::size_t i = 0; i < s.cut.labels.size(); ++i) {
      ASSERT_TRUE(!expected_zero[i] || s.cut.labels[i] == 0U) << i;
    }
    for (std::size_t i = 1; i < s.cut.segments.size(); ++i) {
      EXPECT_GE(s.cut.segments[i - 1].points, s.cut.segments[i].points);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Distances, SceneTest, testing::Values(0.016, 0.020, 0.025, 0.030));

}  // namespace
}  // namespace ph::segment
