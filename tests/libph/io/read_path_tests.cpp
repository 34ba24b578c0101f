// SPDX-License-Identifier: MIT
// Readers that take a path, and the description that read_any gives for each kind of result.
#include <limits>

#include "ph/io/read.hpp"
#include "tests/libph/io/read_support.hpp"

namespace ph::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(ReadPath, OpensTheFileAndReadsIt) {
  const TempDir dir;
  EXPECT_EQ(read_points(dir.write("p.csv", "0,1\n2,3\n")).rows(), 2);
  EXPECT_EQ(read_distances(dir.write("d.csv", "0,1\n1,0\n"))(0, 1), 1);
  EXPECT_EQ(read_lower_distances(dir.write("l.txt", "1\n2 3\n"))(2, 1), 3);
  EXPECT_EQ(read_upper_distances(dir.write("u.txt", "1 2\n3\n"))(2, 1), 3);
  EXPECT_EQ(read_binary_distances(dir.write("b.bin", le(1.5F)))(0, 1), 1.5);
  EXPECT_EQ(read_sparse(dir.write("s.txt", "0 1 2\n")).edges().size(), 1U);
  EXPECT_EQ(read_image(dir.write("i.pgm", "P2 2 1 9 3 4\n")).values[1], 4);
  EXPECT_EQ(read_perseus(dir.write("c.cub", "1\n2\n3\n4\n")).image.values[1], 4);
  EXPECT_EQ(read_simplices(dir.write("c.simplices", "0 : 1\n")).simplices.size(), 1U);
  EXPECT_EQ(read_off(dir.write("m.off", "OFF 1 0 0\n0 0 0\n")).vertices.rows(), 1);
  EXPECT_EQ(read_phat(dir.write("m.phat", "0\n"), dir.write("v.txt", "7\n")).matrix.values[0], 7);
  EXPECT_TRUE(fails_with(ErrorKind::no_input, [&] { read_nifti(dir.file("none.nii")); }));
  EXPECT_TRUE(fails_with(ErrorKind::no_input, [&] { read_ply_mesh(dir.file("none.ply")); }));
}

TEST(ReadAny, TakesValuesForWhatHasVerticesOrCells) {
  const TempDir dir;
  const auto mesh = dir.write("m.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const auto simplices = dir.write("c.simplices", "0 : 0\n1 : 0\n0 1 : 1\n");
  const auto matrix = dir.write("m.phat", "0\n0\n1 0 1\n");
  const auto three = dir.write("three.txt", "1 2 inf\n"), two = dir.write("two.txt", "1 2\n");
  const auto read = [](const auto& path, const auto& values) {
    return read_any(path, Format::automatic, {}, values);
  };
  const ReadResult of_mesh = read(mesh, three);
  EXPECT_EQ(of_mesh.description, "mesh of 3 vertices and 1 faces, OFF");
  EXPECT_EQ(std::get<Mesh>(of_mesh.data).values, (std::vector<double>{1, 2, kInfinity}));
  const ReadResult of_matrix = read(matrix, three);
  EXPECT_EQ(of_matrix.description, "boundary matrix of 3 cells, PHAT ascii");
  EXPECT_EQ(std::get<BoundaryInput>(of_matrix.data).matrix.values[1], 2);
  EXPECT_EQ(std::get<SimplicesInput>(read(simplices, two).data).vertex_values.size(), 2U);
  EXPECT_TRUE(contains(bad_data([&] { read(mesh, two); }), "too few values"));
  EXPECT_TRUE(contains(bad_data([&] { read(simplices, three); }), "too many values"));
  const auto points = dir.write("p.csv", "0,1\n");
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { read(points, two); }));
}

TEST(ReadAny, SaysWhatEachDiphaFileIs) {
  const auto dipha = [](std::int64_t type) {
    return le(std::int64_t{8067171840}) + le(type) + std::string(64, '\0');
  };
  const auto any = [](const std::string& bytes) { read_any(Input::view(bytes, "f.dipha")); };
  for (const std::int64_t type : {0, 1, 2, 7, 8, 3}) bad_data([&] { any(dipha(type)); });
  EXPECT_TRUE(contains(bad_data([&] { any(dipha(2)); }), "a persistence diagram"));
  for (const std::int64_t type : {0, 2, 7, 8}) {
    const std::string bytes = dipha(type);
    EXPECT_TRUE(contains(bad_data([&] { read_image(Input::view(bytes, "f")); }),
                         "another type of DIPHA file"));
  }
}

}  // namespace
}  // namespace ph::test
