// SPDX-License-Identifier: MIT
// Tables with names, indexes and chosen columns, and what is read where nothing says what it is.
#include <algorithm>
#include <limits>

#include "ph/io/formats.hpp"
#include "ph/io/png.hpp"
#include "read_support.hpp"

namespace ph::test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

std::string npy(const std::string& shape, const std::vector<double>& values) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + ", }";
  header.resize(117, ' ');
  std::string bytes = std::string("\x93NUMPY\x01\x00", 8) + le(std::uint16_t{118}) + header + "\n";
  for (const double value : values) bytes += le(value);
  return bytes;
}

ReadResult any(const std::string& bytes, const ReadOptions& options = {}) {
  return read_any(Input::view(bytes, "t.csv"), Format::automatic, options);
}

bool says(const ReadResult& result, const std::string& words) {
  return std::ranges::any_of(result.notes,
                             [&](const std::string& note) { return contains(note, words); });
}

TEST(ReadTable, LeavesAnIndexOut) {
  const Points expected = (Points(2, 2) << 1.5, 2, 3.5, 4).finished();
  for (const std::string text :
       {",x,y\n0,1.5,2\n1,3.5,4\n", "\"\",\"x\",\"y\"\n\"a\",1.5,2\n\"b, c\",3.5,4\n",
        "index;x;y\n1;1.5;2\n2;3.5;4\n", "x y\n1 1.5 2\n2 3.5 4\n", ",0,1\n7,1.5,2\n3,3.5,4\n"}) {
    const ReadResult result = any(text);
    EXPECT_EQ(std::get<Points>(result.data), expected) << text;
    EXPECT_TRUE(says(result, "left out")) << text;
  }
  EXPECT_EQ(std::get<Points>(any("t,x\n0,5\n1,6\n").data).cols(), 2);
  EXPECT_TRUE(says(any("id,x\n4,5\n9,6\n"), "--columns 2-2"));
}

TEST(ReadTable, ChoosesColumns) {
  const std::string text = "name,x,2,y\na,1,2,3\nb,4,5,6\n";
  const auto points = [&](std::vector<std::string> columns) {
    return std::get<Points>(any(text, {.columns = std::move(columns)}).data);
  };
  // A line with a number is no header: columns have numbers only.
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { points({"x"}); }));
  const std::string named = "name,x,u,y\na,1,2,3\nb,4,5,6\n";
  const auto of = [&](std::vector<std::string> columns) {
    return std::get<Points>(any(named, {.columns = std::move(columns)}).data);
  };
  EXPECT_EQ(of({"y", "x"}), (Points(2, 2) << 1, 3, 4, 6).finished());
  EXPECT_EQ(of({"2-3"}), (Points(2, 2) << 1, 2, 4, 5).finished());
  for (const char* wrong : {"z", "5", "0", "3-2", "-", "2-", "99999999999999999999"}) {
    EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { of({wrong}); })) << wrong;
  }
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] { of({"x", "2"}); }));
  EXPECT_TRUE(fails_with(ErrorKind::usage, [&] {
    read_any(Input::view("OFF\n1 0 0\n0 0 0\n", "m.off"), Format::off, {.columns = {"1"}});
  }));
}

TEST(ReadTable, EmptyCellsAreMissingIfNanIsDropped) {
  const std::string text = ",a,b,c\na,1,,0.5\nb,,1,\nc,0.5,,1\n";
  const ReadOptions options{.from_correlation = true, .nan = NanPolicy::drop};
  const auto d = std::get<DistanceMatrix>(any(text, options).data);
  EXPECT_EQ(d(0, 2), 0.5);
  EXPECT_EQ(d(0, 1), kInf);
  EXPECT_EQ(d(2, 1), kInf);
  bad_data([&] { any(text, {.from_correlation = true}); });
}

std::string repeated(std::string_view text, int times) {
  std::string all;
  while (times-- > 0) all += text;
  return all;
}

TEST(ReadTable, CellsOfNothingTakeAByte) {
  const std::string wide = repeated("1,,,,,,,,,2\n", 1000);
  const Points two = std::get<Points>(any(wide, {.columns = {"1", "10"}}).data);
  ASSERT_EQ(two.rows(), 1000);
  EXPECT_TRUE((two.col(0).array() == 1).all() && (two.col(1).array() == 2).all());
  const std::string holes = "1,2,3,4\n" + repeated(",,,\n", 1000);
  EXPECT_EQ(std::get<Points>(any(holes, {.nan = NanPolicy::drop}).data).rows(), 1);
  const ReadResult grid =
      read_any(Input::view(holes, "g.csv"), Format::grid, {.nan = NanPolicy::drop});
  EXPECT_EQ(std::get<Image>(grid.data).extents, (std::vector<Index>{1001, 4}));
  const auto unknown = std::get<DistanceMatrix>(
      read_any(Input::view(repeated(std::string(39, ',') + '\n', 40), "d.csv"), Format::distance,
               {.nan = NanPolicy::drop})
          .data);
  EXPECT_EQ(unknown.size(), 40);
  EXPECT_EQ(unknown(3, 7), kInf);
}

TEST(ReadTable, TheLastCellMayBeEmptyWhereItIsNotTaken) {
  EXPECT_EQ(std::get<Points>(any("1,2,3\n4,5,\n", {.columns = {"1-2"}}).data),
            (Points(2, 2) << 1, 2, 4, 5).finished());
  const auto distances = [](const std::string& text) {
    return std::get<DistanceMatrix>(
        read_any(Input::view(text, "m.csv"), Format::distance, {.columns = {"1-3"}}).data);
  };
  EXPECT_EQ(distances("0,1,2,9\n1,0,3,\n2,3,0,\n")(1, 2), 3);
  const std::string message = bad_data([&] { distances("0,1,2,9,9,9,9\n1,0\n2,3,0,9,9,9,9\n"); });
  EXPECT_TRUE(contains(message, "found 2 cells, expected 7")) << message;
}

TEST(ReadTable, MatricesAreKnownByTheirDiagonal) {
  const auto format = [](const std::string& text) { return any(text).format; };
  EXPECT_EQ(format("0.0e+00 1 2\n1 0.0e+00 3\n2 3 0.0e+00\n"), Format::distance);
  EXPECT_EQ(format("1e-17,1,2\n1,-1e-18,3\n2,3,0\n"), Format::distance);
  EXPECT_EQ(format("a,b,c\n0,1,2\n1,0,3\n2,3,0\n"), Format::distance);
  EXPECT_EQ(format(",a,b,c\na,0,1,2\nb,1,0,3\nc,2,3,0\n"), Format::distance);
  EXPECT_EQ(format("1,2,3\n4,5,6\n7,8,9\n"), Format::points);
  const ReadResult even = any("5,1,2\n1,5,3\n2,3,5\n");
  EXPECT_EQ(even.format, Format::points);
  EXPECT_TRUE(says(even, "symmetric"));
  for (const char* text : {"1,.1,.2\n.1,1,.3\n.2,.3,1\n", "1,0,0\n0,1,0\n0,0,1\n"}) {
    EXPECT_TRUE(contains(bad_data([&] { any(text); }), "--from-correlation")) << text;
    EXPECT_NO_THROW(any(text, {.from_correlation = true}));
    EXPECT_NO_THROW(any(text, {.array = ArrayMeaning::points}));
  }
  EXPECT_TRUE(contains(bad_data([] { any("1,2\n3,4\n5,6\n", {.from_correlation = true}); }),
                       "--from-correlation"));
}

TEST(ReadTable, RowsHaveTheOrderOfTheColumns) {
  EXPECT_EQ(any(",a,b,c\na,0,1,2\nb,1,0,3\nc,2,3,0\n").format, Format::distance);
  EXPECT_TRUE(contains(bad_data([] { any(",a,b,c\nb,0,1,2\na,1,0,3\nc,2,3,0\n"); }), "order"));
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
  EXPECT_TRUE(contains(bad_data([&] { values(Channel::automatic); }), "--channel"));
  bad_data([&] { values(Channel::alpha); });
}

TEST(ReadTable, ArraysAreKnownByShapeAndDiagonal) {
  const auto kind = [](const std::string& shape, const std::vector<double>& values) {
    return any(npy(shape, values)).data.index();
  };
  EXPECT_EQ(kind("(8, 2)", std::vector<double>(16, 1.5)), 0U);
  EXPECT_EQ(kind("(7, 2)", std::vector<double>(14, 1.5)), 3U);
  EXPECT_EQ(kind("(68, 17)", std::vector<double>(68 * 17, 1.5)), 3U);
  EXPECT_EQ(kind("(3, 3)", {0, 1, 2, 1, 0, 3, 2, 3, 0}), 1U);
  EXPECT_EQ(kind("(3, 3)", {0, 1, 2, 1, 0, 3, 2, 4, 0}), 3U);
  EXPECT_EQ(kind("(3, 3)", {0, 0, 0, 0, 0, 0, 0, 0, 0}), 3U);
  bad_data([&] { kind("(3, 3)", {1, .1, .2, .1, 1, .3, .2, .3, 1}); });
  EXPECT_EQ(any(npy("(5,)", {1, 2, 3, 4, 5})).description, "signal of 5 values, NPY");
}

}  // namespace
}  // namespace ph::test
