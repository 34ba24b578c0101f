// SPDX-License-Identifier: MIT
#include "ph/io/cloud.hpp"
#include "tests/libph/io/clouds/motley_cloud.hpp"
#include "tests/libph/io/read_support.hpp"

namespace ph::test {
namespace {

Cloud ply(const std::string& bytes) { return read_ply(Input::view(bytes, "c.ply")); }

TEST(Ply, ReadsBackWhatItWrites) {
  const Cloud cloud = motley(6, 1, false);
  std::ostringstream ascii, binary;
  write_ply(ascii, cloud, PlyData::ascii);
  write_ply(binary, cloud, PlyData::little_endian);
  const Cloud a = ply(ascii.str()), b = ply(binary.str());
  ASSERT_EQ(a.fields.size(), b.fields.size());
  EXPECT_TRUE(a.data == b.data);
  EXPECT_EQ(a.size(), 6);
  for (const char* name : {"x", "red", "green", "blue", "label", "b_2", "h_4"}) {
    EXPECT_NE(a.find(name), nullptr) << name;
  }
  EXPECT_EQ(*a.rgb(), *cloud.rgb());
  EXPECT_TRUE(std::memcmp(a.xyz().data(), cloud.xyz().data(), 18 * sizeof(float)) == 0);
  check_prefixes(
      binary.str(), "c.ply", [](const Input& in) { read_ply(in); }, never());
  const std::string text = ascii.str();
  check_prefixes(
      text, "c.ply", [](const Input& in) { read_ply(in); },
      [&](std::size_t length) { return length + 2 > text.size(); });
  bad_data([&] { ply(binary.str() + "x"); });
  std::ostringstream out;
  bad_data([&] { write_ply(out, motley(2, 1)); });
}

const char* const kPlyHeader =
    "comment made by hand\nobj_info none\nelement camera 1\nproperty float fov\nelement vertex 3\n"
    "property double x\nproperty float y\nproperty int16 z\nproperty list uchar short odd\n"
    "element face 2\nproperty uchar flags\nproperty list uint8 int vertex_indices\nend_header\n";

template <class T>
std::string be(T value) {
  std::string bytes = le(value);
  return {bytes.rbegin(), bytes.rend()};
}

TEST(Ply, ReadsBothByteOrdersListsAndFaces) {
  const std::string ascii = std::string("ply\r\nformat ascii 1.0\n") + kPlyHeader +
                            "0.5\n0.1 1 -1 0\n1 2 3 2 7 8\n4 5 6 1 9\n255 3 0 1 2\n0 2 2 0\n";
  const auto body = [](auto e) {
    using std::int16_t, std::int32_t, std::uint8_t;
    return e(0.5f) + e(0.1) + e(1.f) + e(int16_t{-1}) + e(uint8_t{0}) + e(1.) + e(2.f) +
           e(int16_t{3}) + e(uint8_t{2}) + e(int16_t{7}) + e(int16_t{8}) + e(4.) + e(5.f) +
           e(int16_t{6}) + e(uint8_t{1}) + e(int16_t{9}) + e(uint8_t{255}) + e(uint8_t{3}) +
           e(int32_t{0}) + e(int32_t{1}) + e(int32_t{2}) + e(uint8_t{0}) + e(uint8_t{2}) +
           e(int32_t{2}) + e(int32_t{0});
  };
  const std::string little = std::string("ply\nformat binary_little_endian 1.0\n") + kPlyHeader +
                             body([](auto v) { return le(v); });
  const std::string big = std::string("ply\nformat binary_big_endian 1.0\n") + kPlyHeader +
                          body([](auto v) { return be(v); });
  for (const std::string& bytes : {ascii, little, big}) {
    const Mesh mesh = read_ply_mesh(Input::view(bytes, "m.ply"));
    EXPECT_EQ(mesh.vertices, (Points{{0.1, 1, -1}, {1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(mesh.corners, (std::vector<Index>{0, 1, 2, 2, 0}));
    EXPECT_EQ(mesh.offsets, (std::vector<std::size_t>{0, 3, 5}));
    EXPECT_EQ(ply(bytes).size(), 3);
  }
  for (const std::string& bytes : {little, big}) {
    check_prefixes(
        bytes, "m.ply", [](const Input& in) { read_ply_mesh(in); }, never());
    check_prefixes(
        bytes, "m.ply", [](const Input& in) { read_ply(in); }, never());
  }
  check_prefixes(
      ascii, "m.ply", [](const Input& in) { read_ply_mesh(in); },
      [&](std::size_t length) { return length + 2 > ascii.size(); });
}

// The file has as many property names as fit into a few megabytes. Comparing each name with all
// others would take 10^10 comparisons.
TEST(Ply, ManyPropertiesTakeLinearTime) {
  constexpr int kMany = 100000;
  std::string text = "ply\nformat ascii 1.0\nelement vertex 1\n", row;
  for (int k = 0; k < kMany; ++k) {
    text += "property uchar p" + std::to_string(k) + "\n";
    row += "7 ";
  }
  EXPECT_EQ(read_ply(Input::view(text + "end_header\n" + row + "\n", "c.ply")).stride,
            std::size_t{kMany});
}

TEST(Ply, RefusesDamage) {
  const auto ascii = [](const std::string& rest) { return "ply\nformat ascii 1.0\n" + rest; };
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string list = "element face 1\nproperty list uint int vertex_indices\nend_header\n";
  for (const std::string& bytes : std::vector<std::string>{
           "",
           "ply\n",
           "plyx\n",
           "ply\nend_header\n",
           "ply\nformat ascii 2.0\n",
           "ply\nformat binary 1.0\n",
           ascii("end_header\n"),
           ascii("element vertex 1\nend_header\n1\n"),
           ascii("element vertex 1000000000000\n" + xyz + "end_header\n1 2 3\n"),
           ascii("element vertex 9223372036854775807\n" + xyz + "end_header\n1 2 3\n"),
           ascii("element vertex 9223372036854775808\n" + xyz + "end_header\n1 2 3\n"),
           ascii("element vertex -1\n" + xyz + "end_header\n"),
           ascii("element vertex 0\n" + xyz + "end_header\n"),
           ascii("element vertex 1\n" + xyz + "end_header\n1 2\n"),
           ascii("element vertex 1\n" + xyz + "end_header\n1 2 3 4\n"),
           ascii("element vertex 1\n" + xyz + "end_header\n1 2 3\n4 5 6\n"),
           ascii("element vertex 1\nproperty half x\nend_header\n1\n"),
           ascii("element vertex 1\nproperty float x\nproperty float x\nend_header\n1 2\n"),
           ascii("element vertex 1\nproperty list float int x\nend_header\n1 2\n"),
           ascii("element vertex 1\nelement vertex 1\n"),
           ascii("property float x\n"),
           ascii("element nothing 1000000000000000\nelement vertex 1\n" + xyz +
                 "end_header\n1 2 3\n"),
           ascii("element vertex 1\n" + xyz + list + "1 2 3\n4000000000 0 0\n"),
           ascii("element vertex 1\n" + xyz + list + "1 2 3\n1 1\n"),
           ascii("element vertex 1\n" + xyz + list + "1 2 3\n0\n"),
           ascii("element vertex 1\n" + xyz + list + "1 2 3\n1 -1\n"),
           "ply\nformat binary_little_endian 1.0\nelement vertex 1\n" + xyz + list + le(1.f) +
               le(2.f) + le(3.f) + le(std::uint32_t{4000000000U}) + le(0),
       }) {
    const std::string message = bad_data([&] { read_ply_mesh(Input::view(bytes, "m.ply")); });
    EXPECT_TRUE(contains(message, "m.ply")) << message;
  }
}

}  // namespace
}  // namespace ph::test
