// SPDX-License-Identifier: MIT
#include <zlib.h>
#include <cmath>

#include <limits>

#include "ph/detail/io/png.hpp"
#include "ph/io/cloud.hpp"
#include "ph/io/read.hpp"
#include "tests/libph/io/packed.hpp"
#include "tests/libph/io/read_support.hpp"

namespace ph::test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(ReadPgm, BinaryAndText) {
  const std::vector<double> expected{0, 1, 2, 10, 11, 255};
  const std::string p5 = std::string("P5\n# a comment\n3 2\n255\n") + '\0' + "\x01\x02\x0A\x0B\xFF";
  const std::string p2 = "P2 # text\n3 2 255\n0 1 2\n10 # here too\n11 255\n";
  for (const std::string& bytes : {p5, p2}) {
    const Image image = image_of(bytes, "a.pgm");
    EXPECT_EQ(image.extents, (std::vector<Index>{2, 3}));
    EXPECT_EQ(image.values, expected);
  }
  const std::string deep = std::string("P5 2 1 65535 \x01\x02\xFF\xFF", 17);
  EXPECT_EQ(image_of(deep, "a.pgm").values, (std::vector<double>{258, 65535}));
  EXPECT_EQ(read_image(Input::view(deep, "a")).values[0], 258);
  check_prefixes(
      p5, "a.pgm", [](const Input& in) { read_any(in); }, never());
  check_prefixes(
      p2, "a.pgm", [](const Input& in) { read_any(in); },
      // A text without its last digits may be a valid file, because 2 is a grey value just as 25
      // is.
      [&](std::size_t length) { return length + 3 >= p2.size(); });
}

TEST(ReadPgm, RefusesDamage) {
  expect_refused("a.pgm", {"P5\n3 2\n255\n12345",
                           "P5\n3 2\n255\n1234567",
                           "P5\n0 2\n255\n",
                           "P5\n-1 2\n255\n",
                           "P5\n3 2\n0\n",
                           "P5\n3 2\n65536\n",
                           "P5\n99999999999999999999 2\n255\n",
                           "P5\n2147483648 2147483648 255\nxx",
                           "P5\n1 1\n100\n\xFF",
                           "P5 1 1 255",
                           "P5 1 1",
                           "P5 x 1 255 1",
                           "P2 1 1 255 256",
                           "P2 1 1 255 1 2",
                           "P2 2 1 255 1",
                           "P2 1 1 255 1.5",
                           "P2 1 1 255 -1",
                           "P2 1000000 1000000 255 1 2 3",
                           "P6 1 1 255 abc",
                           std::string("P5 1 1 65535 \xFF", 14)});
}

TEST(ReadPerseus, GridsWithTheFirstAxisFastest) {
  const std::string grid = "2\n2\n3\n0.5\n10\n1\n11\n2\n12\n";
  const PerseusImage read = read_perseus(Input::view(grid, "a.perseus"));
  EXPECT_EQ(read.image.extents, (std::vector<Index>{2, 3}));
  EXPECT_EQ(read.image.values, (std::vector<double>{0.5, 1, 2, 10, 11, 12}));
  EXPECT_EQ(read.periodic, (std::vector<bool>{false, false}));
  const std::string one_line = "# comment\n2\n2 -3\n0.5 10 1 11 2 inf\n";
  ReadResult any = read_any(Input::view(one_line, "a.perseus"));
  EXPECT_EQ(any.periodic, (std::vector<bool>{false, true}));
  EXPECT_EQ(any.description, "image of 2 x 3 voxels, Perseus, periodic");
  EXPECT_TRUE(std::isnan(std::get<Image>(any.data).values.back()));
  EXPECT_TRUE(read_any(Input::view(grid, "a.perseus")).periodic.empty());
  check_prefixes(
      grid, "a.perseus", [](const Input& in) { read_any(in); },
      [&](std::size_t length) { return length + 2 >= grid.size(); });
}

TEST(ReadPerseus, ListsOfCubes) {
  const PerseusImage read = read_perseus(Input::view("2\n0 1 5\n2 0 7\n", "a"));
  EXPECT_EQ(read.image.extents, (std::vector<Index>{3, 2}));
  EXPECT_TRUE(read.image.masked);
  EXPECT_EQ(marked(read.image.values), (std::vector<double>{kMark, 5, kMark, kMark, 7, kMark}));
  expect_refused("a.perseus", {"2\n0 1 5\n0 1 5\n", "2\n0 1 5\n0 1\n", "2\n0 1 5\n0 1 5 6\n",
                               "2\n0 -1 5\n", "2\n0 1.5 5\n", "2\n0 1000000 5\n1000000 0 1\n",
                               "3\n1000000000000 1000000000000 1000000000000 1\n"});
}

TEST(ReadPerseus, MinusOneIsMissingWherePerseusWouldReadIt) {
  const auto values = [](const std::string& text, std::string* note = nullptr) {
    ReadOptions options;
    options.note = [&](const Message& said) {
      if (note != nullptr) *note = said.str();
    };
    return marked(read_perseus(Input::view(text, "a"), options).image.values);
  };
  std::string note;
  EXPECT_EQ(values("1\n3\n1 -1 2\n", &note), (std::vector<double>{1, kMark, 2}));
  EXPECT_TRUE(contains(note, "never enter")) << note;
  EXPECT_EQ(values("1\n3\n0 -1 2\n", &note), (std::vector<double>{0, -1, 2}));
  EXPECT_TRUE(contains(note, "-1, which is read as a number")) << note;
  EXPECT_EQ(values("1\n3\n1.5 -1 2\n"), (std::vector<double>{1.5, -1, 2}));
  EXPECT_EQ(values("1\n3\n-2 -1 2\n"), (std::vector<double>{-2, -1, 2}));
  EXPECT_EQ(values("1\n3\n0.5 inf -inf\n"), (std::vector<double>{0.5, kMark, -kInf}));
}

TEST(ReadPerseus, RefusesDamage) {
  expect_refused("a.perseus", {"", "2\n", "0\n1\n", "-1\n1\n", "99\n1\n", "x\n", "2\n0 1\n",
                               "2\n2 3\n1 2 3 4 5\n", "2\n2 3\n1 2 3 4 5 6 7\n",
                               "2\n2 3\n1 2 3 4 5 nan\n", "2\n2 x\n1 2\n",
                               "2\n1000000000 1000000000\n1 2 3\n", "2\n9223372036854775807 2\n1\n",
                               "2 2 3\n1\n", "2\n1099511627776 1099511627776\n1\n"});
}

struct ZipMember {
  std::string name, bytes;
  bool pack = false;
  std::uint32_t size_lie = 0;
};

std::string zip(const std::vector<ZipMember>& members) {
  std::string file, directory;
  const auto u16 = [](std::size_t n) { return le(static_cast<std::uint16_t>(n)); };
  const auto u32 = [](std::size_t n) { return le(static_cast<std::uint32_t>(n)); };
  for (const ZipMember& m : members) {
    const std::string data = m.pack ? deflated(m.bytes) : m.bytes;
    const auto* raw = reinterpret_cast<const Bytef*>(m.bytes.data());
    const std::string common = u16(0) + u16(m.pack ? 8 : 0) + u32(0) +
                               u32(crc32(0, raw, static_cast<uInt>(m.bytes.size()))) +
                               u32(data.size()) + u32(m.bytes.size() + m.size_lie) +
                               u16(m.name.size()) + u16(0);
    directory += "PK\x01\x02" + u16(20) + u16(20) + common + u16(0) + u16(0) + u16(0) + u32(0) +
                 u32(file.size()) + m.name;
    file += "PK\x03\x04" + u16(20) + common + m.name + data;
  }
  return file + directory + "PK\x05\x06" + u16(0) + u16(0) + u16(members.size()) +
         u16(members.size()) + u32(directory.size()) + u32(file.size()) + u16(0);
}

std::string npy_bytes(const std::vector<double>& values) {
  std::string header =
      "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(values.size()) + ",)}";
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += le(static_cast<std::uint16_t>(header.size())) + header;
  for (const double v : values) bytes += le(v);
  return bytes;
}

TEST(ReadNpz, StoredAndDeflated) {
  const std::string array = npy_bytes({1, 2, 3});
  for (const bool pack : {false, true}) {
    const std::string bytes = zip({{"arr_0.npy", array, pack}});
    const ReadResult result = read_any(Input::view(bytes, "a.npz"));
    EXPECT_EQ(result.format, Format::npz);
    EXPECT_EQ(std::get<Image>(result.data).values, (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(result.notes, std::vector<Message>{"read as a.npz:arr_0"});
    EXPECT_EQ(read_image(Input::view(bytes, "a")).values.size(), 3U);
    check_prefixes(
        bytes, "a.npz", [](const Input& in) { read_any(in); }, never());
    bad_data([&] { read_any(Input::view(bytes + "x", "a.npz")); });
    // Damaged bytes are never read as wrong values.
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      std::string flipped = bytes;
      flipped[i] = static_cast<char>(flipped[i] ^ 0x10);
      fails_with(ErrorKind::bad_data, [&] {
        const ReadResult same = read_any(Input::view(flipped, "a.npz"), Format::npz);
        EXPECT_EQ(std::get<Image>(same.data).values, (std::vector<double>{1, 2, 3})) << i;
      });
    }
  }
}

TEST(ReadNpz, ChoosesAnArray) {
  const TempDir dir;
  const std::string two = zip({{"left.npy", npy_bytes({1})}, {"right.npy", npy_bytes({2}), true}});
  const auto path = dir.write("two.npz", two);
  const std::string message = bad_data([&] { read_any(path); });
  EXPECT_TRUE(contains(message, "2 (left, right)")) << message;
  EXPECT_TRUE(contains(message, "two.npz:left")) << message;
  EXPECT_EQ(read_image(path.string() + ":right").values, std::vector<double>{2});
  EXPECT_TRUE(contains(bad_data([&] { read_image(path.string() + ":up"); }), "left, right"));
  EXPECT_TRUE(fails_with(ErrorKind::no_input, [&] { Input::open(dir.file("no.npz:up")); }));
  bad_data([&] { read_any(Input::view(zip({}), "a.npz"), Format::npz); });
  std::vector<ZipMember> many;
  for (char name = 'a'; name < 'n'; ++name)
    many.push_back({std::string(1, name) + ".npy", npy_bytes({1})});
  EXPECT_TRUE(contains(bad_data([&] { read_any(Input::view(zip(many), "a.npz")); }),
                       "13 (a, b, c, d, e, f, g, h, i, j, ...)"));
}

TEST(ReadNpz, RefusesLiesAndBombs) {
  const std::string array = npy_bytes({1, 2, 3});
  expect_refused("a.npz", {zip({{"a.npy", array, false, 1}}), zip({{"a.npy", array, true, 1}}),
                           zip({{"a.npy", array, true, 0xF0000000}}), zip({{"a.txt", "text"}}),
                           zip({{"a.npy", ""}}), "PK\x03\x04"});
  const std::string bomb = zip({{"a.npy", std::string(std::size_t{130} << 20, '\0'), true}});
  EXPECT_LT(bomb.size(), 300000U);
  EXPECT_TRUE(contains(bad_data([&] { read_any(Input::view(bomb, "a.npz")); }), "expand too much"));
}

TEST(ReadRaw, NumbersBehindAHeader) {
  const auto read = [](const std::string& bytes, const RawLayout& layout) {
    return read_raw(Input::view(bytes, "a.raw"), layout);
  };
  const std::string bytes = std::string("head") + le(std::int16_t{-2}) + le(std::int16_t{258});
  const Image image = read(bytes, {.extents = {2, 1}, .type = "i2", .skip = 4});
  EXPECT_EQ(image.extents, (std::vector<Index>{2, 1}));
  EXPECT_EQ(image.values, (std::vector<double>{-2, 258}));
  EXPECT_EQ(image.values.type(), VoxelType::int16);
  EXPECT_EQ(read(bytes, {.extents = {2}, .type = "u2", .big_endian = true, .skip = 4}).values,
            (std::vector<double>{0xFEFF, 0x0201}));
  EXPECT_EQ(read(bytes, {.extents = {2, 2, 2}}).values.size(), 8U);
  ReadOptions options;
  options.raw = {.extents = {2, 4}};
  const ReadResult result = read_any(Input::view(bytes, "a"), Format::raw, options);
  EXPECT_EQ(result.description, "image of 2 x 4 voxels, raw");
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_TRUE(contains(bad_data([&] {
                           read(bytes.substr(0, length), {{2}, "i2", false, 4});
                         }),
                         "truncated"));
  EXPECT_TRUE(contains(bad_data([&] { read(bytes + "x", {{2}, "i2", false, 4}); }), "trailing"));
  bad_data([&] { read(bytes, {{Index{1} << 62, 4}, "f8", false, 0}); });
  for (const RawLayout& layout :
       {RawLayout{}, RawLayout{{8}, "b1"}, RawLayout{{8}, "c8"}, RawLayout{{-8}}})
    EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { read(bytes, layout); }));
  EXPECT_TRUE(
      fails_with(ErrorKind::usage, [&] { read_any(Input::view(bytes, "a"), Format::raw); }));
}

TEST(ReadRaw, PointsWithoutAHeader) {
  std::string bytes = "head";
  for (const float number : {0.5F, 1.0F, -2.0F, 0.25F, 3.0F, 4.0F, 5.0F, 0.75F})
    bytes += le(number);
  const auto read = [&](const RawLayout& layout, const ReadOptions& options = {}) {
    return read_raw_points(Input::view(bytes, "v.bin"), layout, options);
  };
  const RawLayout four{.type = "f4", .skip = 4, .coordinates = 4};
  EXPECT_EQ(read(four), (Points{{0.5, 1, -2, 0.25}, {3, 4, 5, 0.75}}));
  EXPECT_EQ(read(four, {.columns = {"1-3"}}), (Points{{0.5, 1, -2}, {3, 4, 5}}));
  ReadOptions options{.columns = {"4"}, .raw = four};
  const ReadResult any = read_any(Input::view(bytes, "v.bin"), Format::raw, options);
  EXPECT_EQ(any.description, "2 points in R^1, raw");
  EXPECT_TRUE(contains(bad_data([&] { read({.type = "f4", .coordinates = 4}); }),
                       "byte 32: truncated point, found 4 of its bytes, expected 16"));
  bytes += le(std::nanf("")) + bytes.substr(4, 12);
  EXPECT_TRUE(contains(bad_data([&] { read(four); }), "coordinate 0 of point 2, found NaN"));
  EXPECT_EQ(read(four, {.nan = NanPolicy::drop}).rows(), 2);
  for (const RawLayout& layout :
       {RawLayout{.type = "f4"}, RawLayout{.type = "f3", .coordinates = 4},
        RawLayout{.extents = {2}, .type = "f4", .coordinates = 4},
        RawLayout{.type = "f4", .coordinates = -1}})
    EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { read(layout); }));
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] {
    read_raw(Input::view(bytes, "v.bin"), {.extents = {2}, .coordinates = 1});
  }));
}

TEST(ReadRaw, PointsThatPassForATriangleOfDistances) {
  std::string bytes;
  for (int i = 0; i < 120; ++i) bytes += le(static_cast<float>(i));
  const auto read = [&] { return read_any(Input::view(bytes, "v.bin"), Format::automatic); };
  const ReadResult result = read();
  EXPECT_EQ(std::get<DistanceMatrix>(result.data).size(), 16);
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_EQ(result.notes[0].str(),
            "a file named .bin: read as distances; raw_points 4 reads 30 points of 4 numbers; 3, 5 "
            "and 6 also divide its 120 numbers");
  EXPECT_TRUE(read_any(Input::view(bytes, "v.bin"), Format::binary).notes.empty());
  bytes.replace(8, 4, le(-3.0F));
  EXPECT_TRUE(contains(bad_data(read), "byte 8: negative distance"));
  EXPECT_TRUE(contains(bad_data(read), "raw_points 4 reads 30 points of 4 numbers; 3, 5 and 6"));
  bytes.resize(464);
  EXPECT_TRUE(contains(bad_data(read), "truncated or not a triangle"));
  EXPECT_TRUE(contains(bad_data(read), "raw_points 4 reads 29 points of 4 numbers"));
  bytes.resize(460);  // 115 floats, points of nuScenes
  EXPECT_TRUE(contains(bad_data(read), "raw_points 5 reads 23 points of 5 numbers"));
  bytes.resize(28);
  EXPECT_TRUE(contains(bad_data(read), "raw_points D reads points"));
  bytes = le(1.0F) + le(2.0F) + le(2.5F);
  EXPECT_TRUE(contains(read().notes.at(0).str(), "raw_points 3 reads 1 point of 3 numbers"));
  bytes.clear();
  for (int i = 0; i < 36; ++i) bytes += le(static_cast<float>(i));  // a triangle of 9 points
  EXPECT_TRUE(contains(read().notes.at(0).str(), "4 numbers; 3 and 6 also divide its 36 numbers"));
}

TEST(ReadClouds, XyzAndPts) {
  ReadResult xyz = read_any(Input::view("1 2 3 255 0 0\n4 5 6 0 0 7\nnan 1 1 0 0 0\n", "a.xyzrgb"));
  EXPECT_EQ(xyz.format, Format::xyz);
  EXPECT_EQ(std::get<Points>(xyz.data).cols(), 3);
  EXPECT_EQ(xyz.point_ids, (std::vector<Index>{0, 1}));
  const std::string pts = "3\n1 2 3 -55 255 0 0\n4 5 6 12 0 0 7\n7 8 9 1 2 3 4\n";
  ReadResult counted = read_any(Input::view(pts, "a.pts"));
  EXPECT_EQ(counted.format, Format::pts);
  EXPECT_EQ(counted.description, "3 points in R^3, PTS");
  const Cloud cloud = read_cloud(Input::view(pts, "a.pts"));
  ASSERT_NE(cloud.find("intensity"), nullptr);
  EXPECT_EQ(cloud.rgb()->at(1), 7U);
  EXPECT_EQ(read_any(Input::view("1 2\n3 4\n", "a.pts")).format, Format::points);
  check_prefixes(
      pts, "a.pts", [](const Input& in) { read_pts(in); },
      [&](std::size_t length) { return length + 1 >= pts.size(); });
  expect_refused("a.pts", {"2\n1 2 3\n4 5 6\n7 8 9\n", "3\n1 2 3\n4 5 6\n",
                           "99999999999999\n1 2 3\n", "2\n1 2\n3 4\n", "1\n1 2 inf\n"});
  bad_data([] { read_pts(Input::view("-1\n1 2 3\n", "a.pts")); });
  bad_data([] { read_pts(Input::view("", "a.pts")); });
}

TEST(ReadPicture, TakesOneChannel) {
  const Raster raster{2, 1, 3, 8, {250, 10, 30, 7, 200, 90}};
  std::ostringstream out;
  write_png(out, raster);
  const auto values = [&](Channel channel) {
    const Image image = image_of(out.str(), "a.png", {.channel = channel});
    return std::vector<double>{image.values[0], image.values[1]};
  };
  EXPECT_EQ(values(Channel::red), (std::vector<double>{250, 7}));
  EXPECT_EQ(values(Channel::blue), (std::vector<double>{30, 90}));
  EXPECT_EQ(values(Channel::grey), (std::vector<double>{84, 130}));  // 84.04, 129.753
  EXPECT_TRUE(contains(bad_data([&] { values(Channel::automatic); }), "channel"));
  bad_data([&] { values(Channel::alpha); });
}

}  // namespace
}  // namespace ph::test
