// SPDX-License-Identifier: MIT
// Surfaces that a user fills in are checked before they are written to a file.
#include <gtest/gtest.h>

#include <filesystem>

#include "ph/io/write.hpp"
#include "tests/support/expect_error.hpp"

namespace ph::test {
namespace {

TEST(WriteSurface, RefusesWhatIsNone) {
  const std::vector<double> numbers{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const PointsView points(numbers.data(), 3, 3);
  const auto path = std::filesystem::path(::testing::TempDir()) / "surface.ply";
  std::filesystem::remove(path);
  const auto refused = [&](const SurfaceMesh& mesh, const char* why,
                           const std::vector<Index>& ids = {}) {
    for (const SurfaceFormat format : {SurfaceFormat::ply, SurfaceFormat::off})
      expect_error(ErrorKind::usage, why, [&] {
        OutputFile file(path.string());
        write_surface(file, points, mesh, format, ids);
      });
    EXPECT_FALSE(std::filesystem::exists(path)) << why;
  };
  refused({{{0, 1, 3}}, 1}, "found a corner at point 3, expected 0 to 2");
  refused({{{0, 1, 2}, {-1, 1, 2}}, 2}, "found a corner at point -1, expected 0 to 2");
  refused({{{0, 1, 2}}, 2}, "found 2 regular triangles, expected at most 1");
  refused({{{0, 1, 2}}, 1}, "found numbers for 2 points, expected 3", {5, 6});
  refused({{{0, 1, 2}}, 1}, "found point number -1", {5, -1, 6});
  refused({{{0, 1, 2}}, 1}, "found point number 4294967303, expected 0 to 4294967295",
          {5, 6, (Index{1} << 32) + 7});
  expect_error(ErrorKind::usage, "found points of R^1", [&] {
    OutputFile file(path.string());
    write_surface(file, PointsView(numbers.data(), 3, 1), {}, SurfaceFormat::off);
  });
  OutputFile file(path.string());
  write_surface(file, points, {{{0, 1, 2}}, 1}, SurfaceFormat::off);
  file.commit();
  EXPECT_TRUE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace ph::test
