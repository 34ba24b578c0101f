// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <random>

#include "ph/io/cloud_io.hpp"
#include "ph/io/formats.hpp"
#include "read_support.hpp"

namespace ph::test {
namespace {

std::string header(const std::string& fields, const std::string& size, const std::string& type,
                   const std::string& count, const std::string& width, const std::string& height,
                   const std::string& points, const std::string& data) {
  return "# .PCD v.7\nVERSION .7\nFIELDS " + fields + "\nSIZE " + size + "\nTYPE " + type +
         "\nCOUNT " + count + "\nWIDTH " + width + "\nHEIGHT " + height +
         "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " + data + "\n";
}
std::string xyz_header(const std::string& width, const std::string& height,
                       const std::string& points, const std::string& data) {
  return header("x y z", "4 4 4", "F F F", "1 1 1", width, height, points, data);
}
Cloud pcd(const std::string& bytes, const ReadOptions& options = {}) {
  return read_pcd(Input::view(bytes, "c.pcd"), options);
}

// Every type, counts above one, organised, with holes and extreme numbers.
Cloud motley(Index width, Index height, bool wide_integers = true) {
  Cloud cloud;
  cloud.width = width;
  cloud.height = height;
  cloud.viewpoint = {1, 2, -3.5, 0.5, 0.5, -0.5, 0.5};
  const auto add = [&](const char* name, FieldType type, std::size_t count = 1) {
    cloud.fields.push_back({name, type, count, cloud.stride});
    cloud.stride += count * size_of(type);
  };
  add("x", FieldType::float32);
  add("y", FieldType::float32);
  add("z", FieldType::float32);
  add("rgb", FieldType::float32);
  add("label", FieldType::uint32);
  add("a", FieldType::int8);
  add("b", FieldType::uint8, 3);
  add("c", FieldType::int16);
  add("d", FieldType::uint16, 2);
  add("e", FieldType::int32);
  add("h", FieldType::float64, 5);
  if (wide_integers) {
    add("f", FieldType::int64);
    add("g", FieldType::uint64);
  }
  std::mt19937 random(7);
  cloud.data.resize(static_cast<std::size_t>(cloud.size()) * cloud.stride);
  for (std::size_t i = 0; i < cloud.data.size(); ++i) {
    cloud.data[i] = static_cast<std::byte>(i % 3 == 0 ? random() : 65);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(cloud.size()); ++i) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float xyzc[4] = {i % 4 == 1 ? nan : static_cast<float>(i) / 3, -1e-38f, 1e30f,
                           i % 5 == 2 ? nan : 2.3418052e-38f};
    std::memcpy(cloud.data.data() + i * cloud.stride, xyzc, sizeof(xyzc));
    const double five[5] = {0.1, -1e300, 4.9e-324, 3, static_cast<double>(i)};
    std::memcpy(cloud.data.data() + i * cloud.stride + cloud.find("h")->offset, five, sizeof(five));
  }
  return cloud;
}

void expect_same(const Cloud& a, const Cloud& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.viewpoint, b.viewpoint);
  ASSERT_EQ(a.fields.size(), b.fields.size());
  for (std::size_t k = 0; k < a.fields.size(); ++k) {
    EXPECT_EQ(a.fields[k].name, b.fields[k].name);
    EXPECT_EQ(a.fields[k].type, b.fields[k].type);
    EXPECT_EQ(a.fields[k].count, b.fields[k].count);
    EXPECT_EQ(a.fields[k].offset, b.fields[k].offset);
  }
  EXPECT_TRUE(a.data == b.data);
}

TEST(Pcd, ReadsBackEveryFieldInEveryEncoding) {
  for (const Index height : {1, 7}) {
    const Cloud cloud = motley(300, height);
    for (const PcdData data : {PcdData::ascii, PcdData::binary, PcdData::binary_compressed}) {
      std::ostringstream out;
      write_pcd(out, cloud, data);
      expect_same(pcd(out.str()), cloud);
    }
  }
}

TEST(Pcd, EveryPrefixIsRejected) {
  const Cloud cloud = motley(3, 2);
  for (const PcdData data : {PcdData::ascii, PcdData::binary, PcdData::binary_compressed}) {
    std::ostringstream out;
    write_pcd(out, cloud, data);
    const std::string bytes = out.str();
    // the last number of a text file is complete after each of its digits
    check_prefixes(
        bytes, "c.pcd", [](const Input& in) { read_pcd(in); },
        [&](std::size_t length) { return data == PcdData::ascii && length + 21 > bytes.size(); });
    if (data == PcdData::binary) {
      EXPECT_TRUE(
          contains(bad_data([&] { pcd(bytes.substr(0, bytes.size() - 1)); }), "5 of 6 points"));
    }
    bad_data([&] { pcd(bytes + "1 2 3\n"); });
  }
}

TEST(Pcd, RefusesBadHeadersBeforeAllocating) {
  const std::string body(24, '\0');
  for (const std::string& bytes : std::vector<std::string>{
           "",
           "VERSION .7\n",
           "VERSION 0.8\nFIELDS x\n",
           "VERSION .7\nDATA ascii\n",
           xyz_header("1000000000000", "1", "1000000000000", "binary") + body,
           xyz_header("1000000000000", "1", "1000000000000", "ascii") + "1 2 3\n",
           xyz_header("1000000000000", "1", "1000000000000", "binary_compressed") + body,
           xyz_header("4294967296", "4294967296", "0", "binary") + body,
           xyz_header("9223372036854775807", "1", "9223372036854775807", "binary") + body,
           xyz_header("9223372036854775808", "1", "1", "binary") + body,
           xyz_header("-2", "-1", "2", "binary") + body,
           xyz_header("2", "1", "3", "binary") + body,
           xyz_header("2", "1", "2", "binary") + body + "x",
           xyz_header("2", "1", "2", "gzip") + body,
           xyz_header("2", "1", "2", "") + body,
           xyz_header("2 2", "1", "2", "binary") + body,
           xyz_header("0", "1", "0", "binary"),
           header("x y z", "4 4 4", "F F F", "1 1 2000000000", "2", "1", "2", "binary") + body,
           header("x y z", "4 4 4", "F F F", "1 1 2000000000", "2", "1", "2", "ascii") +
               "1 2 3\n4 5 6\n",
           header("x y z", "4 4 4", "F F F", "1 1 9223372036854775807", "2", "1", "2", "binary") +
               body,
           header("x y z", "4 4 4", "F F F", "1 1 0", "2", "1", "2", "binary") + body,
           header("x y z", "4 4 4", "F F F", "1 1 -1", "2", "1", "2", "binary") + body,
           header("x y z", "4 4 3", "F F F", "1 1 1", "2", "1", "2", "binary") + body,
           header("x y z", "4 4 2", "F F F", "1 1 1", "2", "1", "2", "binary") + body,
           header("x y z", "4 4 4", "F F D", "1 1 1", "2", "1", "2", "binary") + body,
           header("x y z", "4 4", "F F F", "1 1 1", "2", "1", "2", "binary") + body,
           header("x y z", "4 4 4 4", "F F F", "1 1 1", "2", "1", "2", "binary") + body,
           header("x y x", "4 4 4", "F F F", "1 1 1", "2", "1", "2", "binary") + body,
           header("", "", "", "", "2", "1", "2", "binary") + body,
           "VERSION .7\nFIELDS x y z\nFIELDS x y z\n",
           "VERSION .7\nSIZE 4\n",
           "VERSION .7\nCOLOUR 4\n",
           "VERSION .7\nFIELDS x y z\nVIEWPOINT 0 0 0 1 0 0\n",
       }) {
    const std::string message = bad_data([&] { pcd(bytes); });
    EXPECT_TRUE(contains(message, "c.pcd")) << message;
  }
  EXPECT_EQ(pcd(xyz_header("0", "1", "0", "binary"), {.allow_empty = true}).size(), 0);
}

TEST(Pcd, RefusesLyingCompression) {
  std::ostringstream out;
  write_pcd(out, motley(20, 2), PcdData::binary_compressed);
  const std::string whole = out.str();
  const std::size_t start = whole.find("binary_compressed\n") + 18;
  const auto with = [&](std::size_t at, std::uint32_t value) {
    std::string bytes = whole;
    bytes.replace(start + at, 4, le(value));
    return bytes;
  };
  const auto uncompressed = load<std::uint32_t>(
      reinterpret_cast<const std::byte*>(whole.data()) + start + 4, std::endian::little);
  for (const std::string& bytes :
       {with(0, 0), with(0, 1), with(0, 4000000000U), with(4, 0), with(4, uncompressed - 1),
        with(4, uncompressed + 1), with(4, 4000000000U), whole + "x"}) {
    bad_data([&] { pcd(bytes); });
  }
  EXPECT_EQ(pcd(whole + std::string(4000, '\0')).size(), 40);  // PCL pads like that
  bad_data([&] { pcd(whole + std::string(70000, '\0')); });
  // Every byte of the compressed data replaced: an answer or an error, never a read outside.
  for (std::size_t i = start + 8; i < whole.size(); ++i) {
    for (const int value : {0, 31, 32, 255}) {
      std::string bytes = whole;
      bytes[i] = static_cast<char>(value);
      try {
        EXPECT_EQ(pcd(bytes).size(), 40);
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::bad_data);
      }
    }
  }
  // 2000 bytes cannot stand for a gigabyte.
  const std::string bomb = xyz_header("89478485", "1", "89478485", "binary_compressed") +
                           le(std::uint32_t{2000}) + le(std::uint32_t{1073741820}) +
                           std::string(2000, '\xFF');
  EXPECT_TRUE(contains(bad_data([&] { pcd(bomb); }), "compressed size"));
}

TEST(Pcd, ReadsOldAndMinimalHeaders) {
  const Cloud cloud =
      pcd("VERSION 0.5\r\nFIELDS x y z\r\nSIZE 4 4 4\r\nTYPE F F F\r\nPOINTS 2\r\nDATA ascii\r\n1 "
          "2 3\r\nnan 5 6\r\n");
  EXPECT_EQ(cloud.width, 2);
  EXPECT_EQ(cloud.height, 1);
  EXPECT_EQ(cloud.xyz()[2], 3);
  EXPECT_TRUE(std::isnan(cloud.xyz()[3]));
  for (const char* row : {"1 2\n", "1 2 3 4\n", "1 2 x\n", "1 2 1e39\n", "1,2,3\n4 5 6\n", ""}) {
    bad_data([&] { pcd(xyz_header("1", "1", "1", "ascii") + row); });
  }
  for (const char* value : {"256", "-1", "1.5", "x", ""}) {
    bad_data([&] {
      pcd(header("x a", "4 1", "F U", "1 1", "1", "1", "1", "ascii") + "1 " + value + "\n");
    });
  }
}

TEST(Cloud, HolesLabelsAndColours) {
  Cloud cloud =
      pcd(header("x y z rgb label", "4 4 4 4 4", "F F F F U", "1 1 1 1 1", "2", "1", "2", "ascii") +
          "nan nan nan nan 7\n1 2 3 4.2108e+06 8\n");
  EXPECT_TRUE(cloud.rgb().has_value());
  const std::size_t field = cloud.add_field("label_out", FieldType::uint32);
  cloud.set_uint32(field, {1, 2});
  EXPECT_EQ(cloud.xyz()[5], 3);
  EXPECT_EQ(cloud.stride, 24U);
  EXPECT_EQ(cloud.find("nothing"), nullptr);
  std::ostringstream out;
  write_pcd(out, cloud, PcdData::ascii);
  expect_same(pcd(out.str()), cloud);
  std::vector<Index> dropped;
  const Points points = read_points(Input::view(out.str(), "c.pcd"), {.dropped = &dropped});
  EXPECT_EQ(points, (Points(1, 3) << 1, 2, 3).finished());
  EXPECT_EQ(dropped, std::vector<Index>{0});
  bad_data([] { pcd(header("a b", "4 4", "F F", "1 1", "1", "1", "1", "ascii") + "1 2\n").xyz(); });
  const std::string all_holes =
      xyz_header("2", "2", "4", "ascii") + "nan nan nan\nnan nan nan\nnan nan nan\nnan nan nan\n";
  EXPECT_EQ(pcd(all_holes).height, 2);
  EXPECT_TRUE(contains(bad_data([&] { read_any(Input::view(all_holes, "c.pcd")); }), "no points"));
}

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
    EXPECT_EQ(mesh.vertices, (Points(3, 3) << 0.1, 1, -1, 1, 2, 3, 4, 5, 6).finished());
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

// As many as fit a file of some megabytes: 10^10 comparisons if each were held against all others.
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

TEST(Cloud, NamesThatAreNoWordsAreWrittenAsDifferentOnes) {
  Cloud cloud = motley(2, 1, false);
  cloud.fields[3].name = "a b";
  cloud.fields[4].name = "a,b";
  cloud.fields[5].name = "b_1";  // as PLY calls the second number of b
  std::ostringstream as_pcd, as_ply;
  write_pcd(as_pcd, cloud);
  write_ply(as_ply, cloud);
  const Cloud again = pcd(as_pcd.str());
  EXPECT_EQ(again.fields[3].name, "a_b");
  EXPECT_EQ(again.fields[4].name, "a_b_2");
  EXPECT_TRUE(again.data == cloud.data);
  const Cloud split = read_ply(Input::view(as_ply.str(), "c.ply"));
  EXPECT_NE(split.find("b_1"), nullptr);
  EXPECT_NE(split.find("b_1_2"), nullptr);
}

TEST(Pcd, APointHasALargestSize) {
  const std::string many =
      header("x y z w", "4 4 4 8", "F F F F", "1 1 1 1152921504606846975", "0", "1", "0", "ascii");
  EXPECT_TRUE(contains(bad_data([&] { pcd(many, {.allow_empty = true}); }), "points too large"));
}

TEST(ReadXyz, NamesColumns) {
  const auto xyz = [](const std::string& text) { return read_cloud(Input::view(text, "c.xyz")); };
  const Cloud plain = xyz("1 2 3\nnan nan nan\n4000000.123456789 5 6\n");
  EXPECT_EQ(plain.size(), 3);
  EXPECT_EQ(points_of(plain)(2, 0), 4000000.123456789);
  EXPECT_TRUE(std::isnan(points_of(plain)(1, 0)));
  EXPECT_FALSE(plain.rgb().has_value());
  const Cloud coloured = xyz("1 2 3 255 0 16\n");
  EXPECT_EQ(coloured.rgb()->at(0), 0xFF0010U);
  const Cloud normals = xyz("1 2 3 0.5 0 1\n");
  EXPECT_EQ(normals.fields[3].name, "field_3");
  const Cloud named = xyz("label,Z,Y,X\n7,3,2,1\n");
  EXPECT_EQ(points_of(named), (Points(1, 3) << 1, 2, 3).finished());
  for (const char* text : {"1 2\n", "a,b,c\n1,2,3\n", "1 2 inf\n", "", "1 2 3\n4 5\n",
                           "x,y,z,a,a\n0,0,0,1,2\n", "a,x,y,z\n1,2,3,inf\n"}) {
    bad_data([&] { xyz(text); });
  }
}

TEST(CloudFromDepth, BackProjectsPixels) {
  const Raster depth{2, 2, 1, 16, {0, 1000, 2000, 500}};
  const Raster colour{2, 2, 3, 8, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
  const Cloud cloud = cloud_from_depth(depth, colour, {.fx = 2, .fy = 4, .cx = 1, .cy = 0}, 1000);
  EXPECT_EQ(cloud.width, 2);
  EXPECT_EQ(cloud.height, 2);
  const std::vector<float> xyz = cloud.xyz();
  EXPECT_TRUE(std::isnan(xyz[0]) && std::isnan(xyz[1]) && std::isnan(xyz[2]));
  EXPECT_EQ(std::vector<float>(xyz.begin() + 3, xyz.end()),
            (std::vector<float>{0, 0, 1, -1, 0.5, 2, 0, 0.125, 0.5}));
  EXPECT_EQ(*cloud.rgb(), (std::vector<std::uint32_t>{0x010203, 0x040506, 0x070809, 0x0A0B0C}));
  EXPECT_EQ(cloud_from_depth(depth, std::nullopt, {1, 1, 0, 0}).fields.size(), 3U);
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { cloud_from_depth(depth, {}, {0, 1, 0, 0}); }));
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { cloud_from_depth(depth, {}, {1, 1, 0, 0}, 0); }));
  bad_data([&] { cloud_from_depth(colour, {}, {1, 1, 0, 0}); });
  bad_data([&] { cloud_from_depth(depth, Raster{1, 1, 1, 8, {0}}, {1, 1, 0, 0}); });
}

}  // namespace
}  // namespace ph::test
