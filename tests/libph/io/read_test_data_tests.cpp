// SPDX-License-Identifier: MIT
#include <algorithm>

#include "ph/io/cloud.hpp"
#include "ph/io/read.hpp"
#include "tests/libph/io/read_support.hpp"
#include "tests/support/test_data.hpp"

namespace ph::test {
namespace {

TEST(TestData, ReadsEveryReferenceInput) {
  const auto folder = test_data("cases/in");
  if (folder.empty()) GTEST_SKIP() << no_test_data("cases/in");
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto& path = entry.path();
    if (path.extension() == ".vals") continue;
    const auto values = path.extension() == ".phat"
                            ? std::filesystem::path(path).replace_extension(".vals")
                            : std::filesystem::path();
    EXPECT_NO_THROW(read_any(path, Format::automatic, {.allow_empty = true}, values)) << path;
    ++count;
  }
  EXPECT_GT(count, 40U);
  EXPECT_EQ(read_distances(folder / "senate104.txt").size(), 103);
  EXPECT_EQ(read_lower_distances(folder / "random16.txt").size(), 16);
  EXPECT_EQ(read_lower_distances(folder / "projective_plane.txt").size(), 13);
  EXPECT_EQ(read_sparse(folder / "sparse_cycle.txt").size(), 8);
}

TEST(TestData, ReadsAndRewritesEveryScene) {
  const auto folder = test_data("scenes");
  if (folder.empty()) GTEST_SKIP() << no_test_data("scenes");
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".pcd") continue;
    const Cloud cloud = read_cloud(entry.path());
    EXPECT_EQ(cloud.width, 640) << entry.path();
    EXPECT_EQ(cloud.height, 480);
    EXPECT_TRUE(cloud.rgb().has_value());
    std::ostringstream out;
    write_pcd(out, cloud);
    EXPECT_TRUE(read_pcd(Input::view(out.str(), "again")).data == cloud.data) << entry.path();
  }
}

}  // namespace
}  // namespace ph::test
