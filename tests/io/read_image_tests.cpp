// SPDX-License-Identifier: MIT
#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <thread>

#include "ph/io/cloud_io.hpp"
#include "ph/io/formats.hpp"
#include "read_support.hpp"

namespace ph::test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

Image image_of(const std::string& bytes, const std::string& name, const ReadOptions& options = {}) {
  ReadResult result = read_any(Input::view(bytes, name), Format::automatic, options);
  return std::get<Image>(std::move(result.data));
}
void expect_refused(const std::string& name, const std::vector<std::string>& cases) {
  for (const std::string& bytes : cases) {
    const std::string message = bad_data([&] { read_any(Input::view(bytes, name)); });
    EXPECT_TRUE(contains(message, name)) << message;
  }
}

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
      // Text without its last digits may be whole: 2 and 25 are grey values too.
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

struct Nifti {
  std::vector<std::int16_t> dim{2, 2, 3};
  std::int16_t datatype = 4, bitpix = 16;
  float offset = 352, slope = 0, intercept = 0;
  std::string magic = std::string("n+1\0", 4);
  std::int32_t size = 348;
  bool big = false;

  template <class T>
  void put(std::string& bytes, std::size_t at, T value) const {
    std::string raw = le(value);
    if (big) std::reverse(raw.begin(), raw.end());
    std::copy(raw.begin(), raw.end(), bytes.data() + at);
  }
  std::string header() const {
    std::string bytes(352, '\0');
    put(bytes, 0, size);
    for (std::size_t i = 0; i < dim.size(); ++i) put(bytes, 40 + 2 * i, dim[i]);
    put(bytes, 70, datatype);
    put(bytes, 72, bitpix);
    put(bytes, 108, offset);
    put(bytes, 112, slope);
    put(bytes, 116, intercept);
    std::copy_n(magic.begin(), 4, bytes.data() + 344);
    return bytes;
  }
  template <class T>
  std::string with(const std::vector<T>& values) const {
    std::string bytes = header();
    for (const T value : values) {
      bytes.resize(bytes.size() + sizeof(T));
      put(bytes, bytes.size() - sizeof(T), value);
    }
    return bytes;
  }
};

TEST(ReadNifti, EveryDatatypeInBothByteOrders) {
  for (const bool big : {false, true}) {
    const auto check = [&]<class T>(std::int16_t code, T) {
      Nifti n{.datatype = code, .bitpix = 8 * sizeof(T), .big = big};
      const Image image = image_of(n.with(std::vector<T>{0, 10, 1, 11, 2, 12}), "a.nii");
      EXPECT_EQ(image.extents, (std::vector<Index>{2, 3})) << code;
      EXPECT_EQ(image.values, (std::vector<double>{0, 1, 2, 10, 11, 12})) << code;
    };
    check(2, std::uint8_t{});
    check(256, std::int8_t{});
    check(4, std::int16_t{});
    check(512, std::uint16_t{});
    check(8, std::int32_t{});
    check(768, std::uint32_t{});
    check(1024, std::int64_t{});
    check(1280, std::uint64_t{});
    check(16, float{});
    check(64, double{});
  }
}

TEST(ReadNifti, ScalesAndDropsTrailingAxes) {
  const std::vector<std::int16_t> six{0, 10, 1, 11, 2, 12};
  Nifti n{.dim = {5, 2, 3, 1, 1, 1}, .slope = 2, .intercept = -1};
  const Image image = image_of(n.with(six), "a.nii");
  EXPECT_EQ(image.extents, (std::vector<Index>{2, 3}));
  EXPECT_EQ(image.values, (std::vector<double>{-1, 1, 3, 19, 21, 23}));
  n.slope = std::nanf("");
  EXPECT_EQ(image_of(n.with(six), "a.nii").values[5], 12);
  n.dim = {3, 1, 1, 1};
  EXPECT_EQ(image_of(n.with(std::vector<std::int16_t>{7}), "a.nii").extents,
            (std::vector<Index>{1}));
  n = {.datatype = 16, .bitpix = 32};
  const std::string holes = n.with(std::vector<float>{0, 1, 2, 3, 4, std::nanf("")});
  EXPECT_TRUE(contains(bad_data([&] { image_of(holes, "a.nii"); }), "NaN"));
  EXPECT_EQ(image_of(holes, "a.nii", {.nan = NanPolicy::drop}).values[5], kInf);
  Nifti extended{.offset = 368};
  const std::string header = extended.header() + std::string(16, 'e');
  EXPECT_EQ(image_of(header + std::string(12, '\1'), "a.nii").values[0], 257);
}

TEST(ReadNifti, ScalingKeepsToTheBudget) {
  constexpr std::int16_t side = 30;
  constexpr std::size_t voxels = std::size_t{side} * side;
  const auto check = [&]<class T>(std::int16_t code, T, std::size_t needed) {
    Nifti n{.dim = {2, side, side}, .datatype = code, .bitpix = 8 * sizeof(T), .slope = 2};
    const std::string bytes = n.with(std::vector<T>(voxels, T{3}));
    for (const bool is_enough : {true, false}) {
      RunContext context;
      const Input input = held(bytes, "a.nii", context);
      context.memory.set_limit(context.memory.used() + needed - (is_enough ? 0 : 1));
      if (is_enough) {
        const Image image = read_nifti(input, {.context = &context});
        EXPECT_EQ(image.values, Voxels(std::vector<double>(voxels, 6)));
      } else {
        EXPECT_TRUE(fails_with(ErrorKind::resource, [&] {
          read_nifti(input, {.context = &context});
        })) << code;
      }
    }
  };
  // What is stored and what becomes of it; doubles are scaled where they are.
  check(2, std::uint8_t{}, voxels * (1 + 8));
  check(4, std::int16_t{}, voxels * (2 + 8));
  check(16, float{}, voxels * (4 + 8));
  check(64, double{}, voxels * 8);
}

TEST(ReadNifti, ScalingIsStopped) {
  Nifti n{.dim = {2, 300, 300}, .slope = 2};
  std::stop_source source;
  RunContext context;
  context.stop = source.get_token();
  const Input input = held(n.with(std::vector<std::int16_t>(90000)), "a.nii", context);
  context.on_progress = [&](const Progress& progress) {
    if (progress.done == progress.total)  // all was read: what is left is to scale it
      source.request_stop();
    else
      std::this_thread::sleep_for(std::chrono::milliseconds(101));  // the next one is heard, too
  };
  std::this_thread::sleep_for(std::chrono::milliseconds(101));
  EXPECT_TRUE(fails_with(ErrorKind::cancelled, [&] { read_nifti(input, {.context = &context}); }));
}

TEST(ReadNifti, RefusesDamage) {
  const std::vector<std::int16_t> six{0, 10, 1, 11, 2, 12};
  const std::string whole = Nifti{}.with(six);
  check_prefixes(
      whole, "a.nii", [](const Input& in) { read_nifti(in); }, never());
  const auto with = [&](auto change) {
    Nifti n;
    change(n);
    return n.with(six);
  };
  expect_refused(
      "a.nii",
      {whole + "x", with([](Nifti& n) {
         n.dim = {0, 2, 3};
       }),
       with([](Nifti& n) {
         n.dim = {8, 2, 3};
       }),
       with([](Nifti& n) {
         n.dim = {2, 0, 3};
       }),
       with([](Nifti& n) {
         n.dim = {2, -2, -3};
       }),
       with([](Nifti& n) { n.dim = {7, 32767, 32767, 32767, 32767, 32767, 32767, 32767}; }),
       with([](Nifti& n) { n.datatype = 32; }), with([](Nifti& n) { n.datatype = 1; }),
       with([](Nifti& n) { n.datatype = 0; }), with([](Nifti& n) { n.bitpix = 8; }),
       with([](Nifti& n) { n.offset = 0; }), with([](Nifti& n) { n.offset = -352; }),
       with([](Nifti& n) { n.offset = 1e30f; }), with([](Nifti& n) { n.offset = 352.5f; }),
       with([](Nifti& n) { n.offset = std::nanf(""); }), with([](Nifti& n) {
         n.slope = 1;
         n.intercept = std::nanf("");
       }),
       with([](Nifti& n) { n.slope = std::numeric_limits<float>::infinity(); }),
       with([](Nifti& n) { n.magic = "abcd"; }), with([](Nifti& n) { n.size = 349; })});
  EXPECT_TRUE(contains(
      bad_data([&] { image_of(with([](Nifti& n) { n.magic = std::string("ni1\0", 4); }), "a"); }),
      "pair"));
  EXPECT_TRUE(contains(bad_data([&] { image_of(with([](Nifti& n) { n.size = 540; }), "a.nii"); }),
                       "version"));
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
  EXPECT_EQ(std::get<Image>(any.data).values.back(), kInf);
  EXPECT_TRUE(read_any(Input::view(grid, "a.perseus")).periodic.empty());
  check_prefixes(
      grid, "a.perseus", [](const Input& in) { read_any(in); },
      [&](std::size_t length) { return length + 2 >= grid.size(); });
}

TEST(ReadPerseus, ListsOfCubes) {
  const PerseusImage read = read_perseus(Input::view("2\n0 1 5\n2 0 7\n", "a"));
  EXPECT_EQ(read.image.extents, (std::vector<Index>{3, 2}));
  EXPECT_EQ(read.image.values, (std::vector<double>{kInf, 5, kInf, kInf, 7, kInf}));
  expect_refused("a.perseus", {"2\n0 1 5\n0 1 5\n", "2\n0 1 5\n0 1\n", "2\n0 1 5\n0 1 5 6\n",
                               "2\n0 -1 5\n", "2\n0 1.5 5\n", "2\n0 1000000 5\n1000000 0 1\n",
                               "3\n1000000000000 1000000000000 1000000000000 1\n"});
}

TEST(ReadPerseus, MinusOneIsMissingWherePerseusWouldReadIt) {
  const auto values = [](const std::string& text, std::string* note = nullptr) {
    ReadOptions options;
    options.note = [&](std::string said) {
      if (note != nullptr) *note = std::move(said);
    };
    return read_perseus(Input::view(text, "a"), options).image.values;
  };
  std::string note;
  EXPECT_EQ(values("1\n3\n1 -1 2\n", &note), (std::vector<double>{1, kInf, 2}));
  EXPECT_TRUE(contains(note, "never enter")) << note;
  EXPECT_EQ(values("1\n3\n0 -1 2\n", &note), (std::vector<double>{0, -1, 2}));
  EXPECT_TRUE(contains(note, "taken as such")) << note;
  EXPECT_EQ(values("1\n3\n1.5 -1 2\n"), (std::vector<double>{1.5, -1, 2}));
  EXPECT_EQ(values("1\n3\n-2 -1 2\n"), (std::vector<double>{-2, -1, 2}));
}

TEST(ReadPerseus, RefusesDamage) {
  expect_refused("a.perseus", {"", "2\n", "0\n1\n", "-1\n1\n", "99\n1\n", "x\n", "2\n0 1\n",
                               "2\n2 3\n1 2 3 4 5\n", "2\n2 3\n1 2 3 4 5 6 7\n",
                               "2\n2 3\n1 2 3 4 5 nan\n", "2\n2 x\n1 2\n",
                               "2\n1000000000 1000000000\n1 2 3\n", "2\n9223372036854775807 2\n1\n",
                               "2 2 3\n1\n", "2\n1099511627776 1099511627776\n1\n"});
}

std::string deflated(const std::string& bytes) {
  std::string out(compressBound(bytes.size()) + 64, '\0');
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
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
    EXPECT_EQ(result.notes, std::vector<std::string>{"read as a.npz:arr_0"});
    EXPECT_EQ(read_image(Input::view(bytes, "a")).values.size(), 3U);
    check_prefixes(
        bytes, "a.npz", [](const Input& in) { read_any(in); }, never());
    bad_data([&] { read_any(Input::view(bytes + "x", "a.npz")); });
    for (std::size_t i = 0; i < bytes.size(); ++i) {  // wrong values are never taken
      std::string flipped = bytes;
      flipped[i] = static_cast<char>(flipped[i] ^ 0x10);
      try {
        const ReadResult same = read_any(Input::view(flipped, "a.npz"), Format::npz);
        EXPECT_EQ(std::get<Image>(same.data).values, (std::vector<double>{1, 2, 3})) << i;
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::bad_data) << i << error.what();
      }
    }
  }
}

TEST(ReadNpz, ChoosesAnArray) {
  const TempDir dir;
  const std::string two = zip({{"left.npy", npy_bytes({1})}, {"right.npy", npy_bytes({2}), true}});
  const auto path = dir.write("two.npz", two);
  const std::string message = bad_data([&] { read_any(path); });
  EXPECT_TRUE(contains(message, "2: left, right")) << message;
  EXPECT_TRUE(contains(message, "two.npz:left")) << message;
  EXPECT_EQ(read_image(path.string() + ":right").values, std::vector<double>{2});
  EXPECT_TRUE(contains(bad_data([&] { read_image(path.string() + ":up"); }), "left, right"));
  EXPECT_TRUE(fails_with(ErrorKind::no_input, [&] { Input::open(dir.file("no.npz:up")); }));
  bad_data([&] { read_any(Input::view(zip({}), "a.npz"), Format::npz); });
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

}  // namespace
}  // namespace ph::test
