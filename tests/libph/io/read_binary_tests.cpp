// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "ph/io/cloud.hpp"
#include "ph/io/read.hpp"
#include "tests/libph/io/read_support.hpp"

namespace ph::test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

std::string npy(const std::string& header, const std::string& data) {
  std::string bytes("\x93NUMPY\x01\x00", 8);
  return bytes + le(static_cast<std::uint16_t>(header.size())) + header + data;
}
std::string npy(const std::string& descr, const std::string& order, const std::string& shape,
                const std::string& data) {
  return npy(
      "{'descr': '" + descr + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }\n",
      data);
}
Image image(const std::string& bytes, const ReadOptions& options = {}) {
  return read_npy_image(Input::view(bytes, "a.npy"), options);
}

TEST(ReadNpy, PointsKeepToTheBudget) {
  constexpr std::size_t numbers = 3 * 500;
  std::string floats, doubles;
  for (std::size_t k = 0; k < numbers; ++k) {
    floats += le(static_cast<float>(k));
    doubles += le(static_cast<double>(k));
  }
  const auto check = [](const std::string& bytes, std::size_t needed) {
    RunContext context;
    const Input input = held(bytes, "a.npy", context);
    const std::size_t before = context.memory.used();
    context.memory.set_limit(before + needed);
    const Points points = read_points(input, {.context = &context});
    for (Index k = 0; k < points.size(); ++k) ASSERT_EQ(points(k / 3, k % 3), k);
    context.memory.set_limit(before + needed - 1);
    EXPECT_TRUE(
        fails_with(ErrorKind::resource, [&] { read_points(input, {.context = &context}); }));
  };
  // Memory is needed for the array and for the points.
  check(npy("<f4", "False", "(500, 3)", floats), numbers * (4 + 8));
  check(npy("<f8", "False", "(500, 3)", doubles), numbers * (8 + 8));
}

TEST(ReadNpy, ReadsEveryElementType) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"|b1", std::string("\1\0", 2)},
      {"|u1", std::string("\1\0", 2)},
      {"|i1", std::string("\1\0", 2)},
      {"<u2", le<std::uint16_t>(1) + le<std::uint16_t>(0)},
      {">u2", std::string("\0\1\0\0", 4)},
      {"<i4", le<std::int32_t>(1) + le<std::int32_t>(0)},
      {"<u8", le<std::uint64_t>(1) + le<std::uint64_t>(0)},
      {"<f2", std::string("\x00\x3C\x00\x80", 4)},
      {"<f4", le(1.0f) + le(-0.0f)},
      {"<f8", le(1.0) + le(-0.0)}};
  for (const auto& [descr, data] : cases) {
    const Image read = image(npy(descr, "False", "(2,)", data));
    EXPECT_EQ(read.extents, std::vector<Index>{2}) << descr;
    EXPECT_EQ(read.values, (std::vector<double>{1, 0})) << descr;
    EXPECT_FALSE(std::signbit(read.values[1])) << descr;
  }
  EXPECT_EQ(image(npy("|i1", "False", "(2,)", "\xFF\x80")).values, (std::vector<double>{-1, -128}));
  const std::string half("\x01\x00\xFF\x7B\x00\x7C\x00\xFC", 8);
  EXPECT_EQ(image(npy("<f2", "False", "(4,)", half)).values,
            (std::vector<double>{std::ldexp(1, -24), 65504, kInf, -kInf}));
}

TEST(ReadNpy, BringsFortranOrderToCOrder) {
  std::string data;
  for (int z = 0; z < 4; ++z) {
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 2; ++x) data += static_cast<char>(100 * x + 10 * y + z);
    }
  }
  const Image read = image(npy("|u1", "True", "(2, 3, 4)", data));
  std::size_t k = 0;
  for (int x = 0; x < 2; ++x) {
    for (int y = 0; y < 3; ++y) {
      for (int z = 0; z < 4; ++z) EXPECT_EQ(read.values[k++], 100 * x + 10 * y + z);
    }
  }
}

TEST(ReadNpy, BringsFortranOrderOfAnyShapeToCOrder) {
  for (const std::vector<Index>& extents : std::vector<std::vector<Index>>{
           {19}, {1, 9}, {9, 1}, {17, 8}, {8, 23}, {11, 3, 9}, {2, 1, 3, 1, 2}, {9, 2, 2, 17}}) {
    // The value of each element is its position in C order. The array is written such that the
    // first axis varies fastest.
    std::size_t count = 1;
    std::string shape;
    for (const Index extent : extents) {
      count *= static_cast<std::size_t>(extent);
      shape += std::to_string(extent) + ",";
    }
    std::vector<double> values;
    std::vector<Index> at(extents.size(), 0);
    std::string data;
    for (std::size_t k = 0; k < count; ++k) {
      Index place = 0;
      for (std::size_t axis = 0; axis < extents.size(); ++axis) {
        place = place * extents[axis] + at[axis];
      }
      data += le(static_cast<double>(place));
      for (std::size_t axis = 0; axis < extents.size() && ++at[axis] == extents[axis]; ++axis) {
        at[axis] = 0;
      }
      values.push_back(static_cast<double>(k));
    }
    const Image read = image(npy("<f8", "True", "(" + shape + ")", data));
    EXPECT_EQ(read.extents, extents) << shape;
    EXPECT_EQ(read.values, values) << shape;
  }
}

TEST(ReadNpy, RefusesDamage) {
  const std::string two = le(1.0) + le(2.0);
  for (const std::string& bytes : std::vector<std::string>{
           npy("<f8", "False", "(3,)", two),
           npy("<f8", "False", "(1,)", two),
           npy("<f8", "False", "(1000000000000,)", two),
           npy("<f8", "False", "(4294967296, 4294967296)", two),
           npy("<f8", "False", "(9223372036854775808,)", two),
           npy("<f8", "False", "(-1,)", two),
           npy("<f8", "False", "(2.5,)", two),
           npy("<f8", "False", "(2", two),
           npy("<f8", "Maybe", "(2,)", two),
           npy("<c16", "False", "(1,)", two),
           npy("|O", "False", "(2,)", two),
           npy("<U4", "False", "(1,)", two),
           npy("f8", "False", "(2,)", two),
           npy("<f8", "False", "(0,)", ""),
           npy("<f8", "False", "(2,)", le(1.0) + le(std::nan(""))),
           npy("<i8", "False", "(1,)", le((std::int64_t{1} << 53) + 1)),
           npy("<u8", "False", "(1,)", le(~std::uint64_t{0})),
           npy("|b1", "False", "(1,)", "\2"),
           npy("{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (2,)}", two),
           npy("{'descr': '<f8', 'shape': (2,)}", two),
           npy("{'descr': '<f8', 'descr': '<f8', 'fortran_order': False, 'shape': (2,)}", two),
           npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2,)} + exit()", two),
           std::string("\x93NUMPY\x04\x00\x00\x00", 10),
       }) {
    const std::string message = bad_data([&] { image(bytes); });
    EXPECT_TRUE(contains(message, "a.npy")) << message;
  }
  const std::string whole = npy("<f8", "False", "(2,)", two);
  check_prefixes(
      whole, "a.npy", [](const Input& in) { read_npy_image(in); }, never());
  EXPECT_TRUE(contains(bad_data([&] { image(whole.substr(0, whole.size() - 1)); }), "truncated"));
}

TEST(ReadNpy, MasksAndReadsAsPointsAndDistances) {
  const std::string data = le(1.0) + le(std::nan("")) + le(kInf) + le(-kInf);
  const Image masked = image(npy("<f8", "False", "(4,)", data), {.nan = NanPolicy::drop});
  EXPECT_TRUE(masked.masked);
  EXPECT_EQ(marked(masked.values), (std::vector<double>{1, kMark, kInf, -kInf}));
  EXPECT_EQ(image(npy("<f8", "False", "(0, 3)", ""), {.allow_empty = true}).values.size(), 0U);
  const std::string square = npy("<f8", "False", "(2, 2)", le(0.0) + le(1.0) + le(1.0) + le(0.0));
  EXPECT_EQ(read_distances(Input::view(square, "a.npy"))(0, 1), 1);
  EXPECT_EQ(read_points(Input::view(square, "a.npy"))(1, 0), 1);
  const auto as = [&](ArrayMeaning meaning) {
    return read_any(Input::view(square, "a"), Format::automatic, {.array = meaning}).data.index();
  };
  EXPECT_EQ(as(ArrayMeaning::points), 0U);
  EXPECT_EQ(as(ArrayMeaning::distances), 1U);
  EXPECT_EQ(as(ArrayMeaning::image), 3U);
  const std::string skew = npy("<f8", "False", "(2, 2)", le(0.0) + le(1.0) + le(2.0) + le(0.0));
  EXPECT_TRUE(contains(bad_data([&] { read_distances(Input::view(skew, "a")); }), "asymmetric"));
  const std::string wide = npy("<f8", "False", "(1, 2)", le(0.0) + le(1.0));
  EXPECT_TRUE(contains(bad_data([&] { read_distances(Input::view(wide, "a")); }), "not a square"));
}

TEST(WriteNpy, ReadsBack) {
  const std::vector<std::uint32_t> labels{0, 1, 4000000000U, 3, 2, 1};
  std::ostringstream out;
  write_npy(out, labels, 3, 2);
  const Image back = image(out.str());
  EXPECT_EQ(back.extents, (std::vector<Index>{2, 3}));
  EXPECT_EQ(back.values, std::vector<double>(labels.begin(), labels.end()));
  EXPECT_EQ(out.str().find('\n') % 64, 63U);
  std::ostringstream flat;
  write_npy(flat, labels, 6);
  EXPECT_EQ(image(flat.str()).extents, std::vector<Index>{6});
  bad_data([&] { write_npy(flat, labels, 5); });
}

std::string int64s(const std::vector<std::int64_t>& numbers) {
  std::string bytes;
  for (const std::int64_t n : numbers) bytes += le(n);
  return bytes;
}

TEST(ReadPhat, ReadsAsciiAndBinary) {
  const std::string ascii = "# edge\n0\n0\n1 0 1\n";
  const std::string binary = int64s({3, 0, 0, 0, 0, 1, 2, 0, 1});
  for (const std::string& bytes : {ascii, binary}) {
    const BoundaryInput b = read_phat(Input::view(bytes, "b.phat"));
    EXPECT_EQ(b.matrix.dims, (std::vector<int>{0, 0, 1}));
    EXPECT_EQ(b.matrix.offsets, (std::vector<std::size_t>{0, 0, 0, 2}));
    EXPECT_EQ(b.matrix.rows, (std::vector<Index>{0, 1}));
    EXPECT_TRUE(b.matrix.incidences.empty());
  }
  EXPECT_EQ(read_phat(Input::view(ascii, "b.phat")).namer()(2), "b.phat:4");
  EXPECT_EQ(read_phat(Input::view(binary, "b.phat")).namer()(2), "b.phat: byte 40 (cell 2)");
  check_prefixes(
      binary, "b.phat", [](const Input& in) { read_phat(in); }, never());
}

TEST(ReadPhat, RefusesDamage) {
  for (const std::string& bytes : std::vector<std::string>{
           "", "0\n0\n1 0 2\n", "0\n0\n1 1 0\n", "0\n0\n1 0 0\n", "0\n0\n1 -1 0\n", "-1\n",
           "0\n1 0.5\n", "0\n99999999999 0\n", int64s({1000000000000}), int64s({-1}),
           int64s({std::numeric_limits<std::int64_t>::max(), 0, 0}), int64s({1, 0, 4000000000}),
           int64s({1, 0, -1}), int64s({1, -1, 0}), int64s({1, 0, 0, 7}), int64s({2, 0, 0, 1, 1, 1}),
           int64s({1, std::int64_t{1} << 40, 0})}) {
    bad_data([&] { read_phat(Input::view(bytes, "b.phat")); });
  }
}

TEST(ReadPhat, TakesValues) {
  const TempDir dir;
  const auto matrix = dir.write("b.phat", "0\n0\n1 0 1\n");
  const auto text = dir.write("v.txt", "0 0\n1.5\n");
  const auto raw = dir.write("v.vals", le(0.0) + le(0.0) + le(1.5));
  const std::vector<double> expected{0, 0, 1.5};
  EXPECT_EQ(read_phat(matrix, text).matrix.values, expected);
  EXPECT_EQ(read_phat(matrix, raw).matrix.values, expected);
  // A double, some of whose bytes are printable characters. The bytes are not valid UTF-8.
  EXPECT_EQ(read_values(Input::view("\xda\x29\xc1\xd3\xbc\x3b\xd3\x3f", "v"), 1).size(), 1U);
  bad_data([] { read_values(Input::view("1.5 abc\n", "v"), 1); });
  const ReadResult any = read_any(matrix, Format::automatic, {}, raw);
  EXPECT_EQ(std::get<BoundaryInput>(any.data).matrix.values, expected);
  for (const std::string& values :
       {std::string("0 0\n"), std::string("0 0 1 2\n"), std::string("0 0 nan\n"), le(0.0) + le(0.0),
        le(0.0) + le(0.0) + le(std::nan("")), le(0.0) + le(0.0) + "abc", std::string()}) {
    bad_data([&] { read_values(Input::view(values, "v"), 3); });
  }
}

Raster raster(int channels, int bits) {
  Raster r{5, 3, channels, bits, {}};
  for (int k = 0; k < 15 * channels; ++k) {
    r.samples.push_back(static_cast<std::uint16_t>(k * (bits == 16 ? 1091 : 4)));
  }
  return r;
}

TEST(Png, WritesWhatItReads) {
  for (const int bits : {8, 16}) {
    for (const int channels : {1, 2, 3, 4}) {
      const Raster r = raster(channels, bits);
      std::ostringstream out;
      write_png(out, r);
      const Raster back = read_png(Input::view(out.str(), "r.png"));
      EXPECT_EQ(back.width, 5);
      EXPECT_EQ(back.height, 3);
      EXPECT_EQ(back.channels, channels);
      EXPECT_EQ(back.bits, bits);
      EXPECT_EQ(back.samples, r.samples);
      check_prefixes(
          out.str(), "r.png", [](const Input& in) { read_png(in); }, never());
      EXPECT_TRUE(
          contains(bad_data([&] { read_png(Input::view(out.str() + "x", "r.png")); }), "trailing"));
    }
  }
  std::ostringstream out;
  bad_data([&] { write_png(out, Raster{2, 2, 1, 8, {1, 2, 3}}); });
  write_png(out, raster(1, 16));
  const Image grey = read_image(Input::view(out.str(), "r.png"));
  EXPECT_EQ(grey.extents, (std::vector<Index>{3, 5}));
  EXPECT_EQ(grey.values[7], 7 * 1091);
  std::ostringstream rgb;
  write_png(rgb, raster(3, 8));
  bad_data([&] { read_image(Input::view(rgb.str(), "r.png")); });
}

TEST(Png, RefusesAnyFlippedByte) {
  std::ostringstream out;
  write_png(out, raster(1, 16));
  const std::string whole = out.str();
  const Raster right = raster(1, 16);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string bytes = whole;
    bytes[i] = static_cast<char>(bytes[i] ^ 0x20);
    // If a bit is flipped in the name of a chunk, decoders may be allowed to skip the chunk.
    fails_with(ErrorKind::bad_data, [&] {
      EXPECT_EQ(read_png(Input::view(bytes, "r.png")).samples, right.samples) << i;
    });
  }
  // Keeps only the signature and the IHDR chunk, so the pixels are missing.
  std::string bomb = whole.substr(0, 33);
  bomb[16] = bomb[20] = 0;
  EXPECT_TRUE(contains(bad_data([&] { read_png(Input::view(bomb, "r.png")); }), "r.png: byte"));
}

}  // namespace
}  // namespace ph::test
