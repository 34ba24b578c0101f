// SPDX-License-Identifier: MIT
// The meaning of files that do not state it: bytes without a header, files of other programs, and
// tables and arrays that may be points, distances, correlations or images.
#include <cmath>
#include <limits>

#include "tests/libph/io/points/read_any.hpp"

namespace ph::test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(ReadGuesses, BytesWithoutAHeaderNameTheRawOptions) {
  std::string smooth;  // a volume whose values are between 120 and 180
  for (int i = 0; i < 4096; ++i) smooth += static_cast<char>(150 + 30 * std::sin(0.02 * i));
  for (const std::string& bytes :
       {std::string("\1\2\3\4\5\6"), std::string("\x40\0\0\x80", 4), smooth}) {
    const std::string message =
        bad_data([&] { read_any(Input::view(bytes, "x.raw"), Format::automatic); });
    EXPECT_TRUE(contains(message, "not plain text")) << message;
    EXPECT_TRUE(contains(message, "raw_shape") && contains(message, "raw_points")) << message;
  }
  EXPECT_EQ(std::get<Points>(any("# page\f\n1 2\n3 4\n").data).rows(), 2);
  EXPECT_EQ(std::get<Points>(any("gr\xf6\xdf"
                                 "e,h\xf6he\n1,2\n3,4\n")
                                 .data)
                .rows(),
            2)
      << "Latin-1";
}

TEST(ReadGuesses, FilesOfOtherProgramsAreNamedWithAWayOut) {
  const std::string zeros(300, '\0');
  const std::string ptx = "2\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  struct Case {
    std::string bytes;
    const char *name, *way;
  };
  const std::vector<Case> cases{
      {zeros.substr(0, 128) + "DICM\2\0", "DICOM", "NIfTI"},
      {zeros.substr(0, 208) + "MAP DA" + zeros, "MRC", "NIfTI"},
      {"SIMPLE  =                    T / conforms\n", "FITS", ".npy"},
      {"PF\n2 1\n-1.0\n" + zeros, "PFM", ".npy"},
      {"Pf\n2 1\n-1.0\n" + zeros, "PFM", ".npy"},
      {"\x89MCAP0\r\n" + zeros, "MCAP", "PCD"},
      {"#ROSBAG V2.0\n" + zeros, "ROS bag", "PCD"},
      {std::string("SQLite format 3\0", 16) + zeros, "ROS 2 bag", "PCD"},
      {std::string("glTF\2\0\0\0", 8), "GLB", "PLY"},
      {std::string("\x80\4\x95\x10\0\0", 6), "pickle", "numpy.save"},
      {std::string("\x80\3cnumpy\n"), "pickle", "numpy.save"},
      {ptx + "0.5 1 2 0.25\n0.5 1 3 0.25\n", "PTX", "PLY"},
      {ptx + "0.5 1 2 0.25 9 9 9\n", "PTX", "PLY"},
      {"<?xml version=\"1.0\"?>\n<!DOCTYPE GIFTI>\n<GIFTI Version=\"1.0\">\n", "GIFTI", "PLY"},
      {"<VTKFile type=\"PolyData\" version=\"1.0\">\n", "VTK", ".npy"},
      {"<?xml version=\"1.0\"?>\n<data/>\n", "XML", "text"},
  };
  for (const auto& [bytes, name, way] : cases) {
    const std::string message = bad_data([&] { any(bytes); });
    EXPECT_TRUE(contains(message, name)) << name << ": " << message;
    EXPECT_TRUE(contains(message, way)) << name << ": " << message;
  }
  // Tables that only begin like one of these files are read.
  for (const char* text : {"glTF,b\n1,2\n3,4\n", "PF\n1\n2\n3\n", "NDims,b\n1,2\n3,4\n",
                           "NRRD,b\n1,2\n3,4\n", "SIMPLE,b\n1,2\n3,4\n"})
    EXPECT_GE(std::get<Points>(any(text).data).rows(), 2) << text;
  EXPECT_FALSE(contains(bad_data([&] { any(ptx); }), "PTX")) << "no points";
}

TEST(ReadGuesses, MatricesAreKnownByTheirDiagonal) {
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
    EXPECT_TRUE(contains(bad_data([&] { any(text); }), "from_correlation")) << text;
    EXPECT_NO_THROW(any(text, {.from_correlation = true}));
    EXPECT_NO_THROW(any(text, {.array = ArrayMeaning::points}));
  }
  EXPECT_TRUE(contains(bad_data([] { any("1,2\n3,4\n5,6\n", {.from_correlation = true}); }),
                       "from_correlation"));
}

// A matrix that is nearly symmetric is accepted. The differences only need to be small compared to
// the largest entry of the matrix, even if the entries that differ are small themselves.
TEST(ReadGuesses, RoundingIsRelativeToTheLargestEntry) {
  const char* correlations = "1,1e-17,0.5\n-2e-17,1,0.25\n0.5,0.25,1\n";
  EXPECT_TRUE(contains(bad_data([&] { any(correlations); }), "from_correlation"));
  EXPECT_EQ(std::get<DistanceMatrix>(any(correlations, {.from_correlation = true}).data)(0, 2),
            0.5);
  // Two corresponding correlations are near 1. Their distances are small, and differ by more than a
  // factor of 1 + 1e-6.
  const char* near = "1,0.999999,0.5\n0.9999991,1,0.5\n0.5,0.5,1\n";
  EXPECT_NO_THROW(any(near, {.from_correlation = true}));

  const auto distances = [](const std::string& text) {
    const ReadResult result = any(text);
    EXPECT_EQ(result.format, Format::distance) << text;
    return std::get<DistanceMatrix>(result.data);
  };
  EXPECT_EQ(distances("0,1e-9,2\n2e-9,0,3\n2,3,0\n")(0, 1), 2e-9);
  EXPECT_EQ(distances("0,-2e-16,1\n-2e-16,0,1\n1,1,0\n")(0, 1), 0);
  EXPECT_TRUE(says(any("0,-2e-16,1\n-2e-16,0,1\n1,1,0\n"), "0 or more except for rounding"));
  for (const auto& [text, words] : std::vector<std::pair<const char*, const char*>>{
           {"0,1e-5,2\n2e-5,0,3\n2,3,0\n", "t.csv:2:1: asymmetric"},
           {"0,1,2\n1,0,-3e-5\n2,-3e-5,0\n", "t.csv:2:5: negative"},
           {"0,inf,2\n1,0,3\n2,3,0\n", "t.csv:2:1: asymmetric"}}) {
    EXPECT_TRUE(contains(bad_data([&] { any(text); }), words)) << bad_data([&] { any(text); });
  }
  // Infinity is not close to any number.
  EXPECT_FALSE(says(any(npy("(3, 3)", {5, kInf, 2, 1, 5, 3, 2, 3, 5})), "symmetric"));
  const auto lower = [](const char* text) {
    return read_lower_distances(Input::view(text, "l"))(1, 0);
  };
  EXPECT_EQ(lower("-1e-17\n2 3\n"), 0);
  EXPECT_TRUE(contains(bad_data([&] { lower("-1e-5\n2 3\n"); }), "l:1:1: negative"));
}

TEST(ReadGuesses, ArraysAreKnownByShapeAndDiagonal) {
  const auto kind = [](const std::string& shape, const std::vector<double>& values) {
    return any(npy(shape, values)).data.index();
  };
  EXPECT_EQ(kind("(8, 2)", std::vector<double>(16, 1.5)), 0U);
  EXPECT_EQ(kind("(7, 2)", std::vector<double>(14, 1.5)), 3U);
  EXPECT_EQ(kind("(68, 17)", std::vector<double>(68 * 17, 1.5)), 3U);
  EXPECT_EQ(kind("(3, 3)", {0, 1, 2, 1, 0, 3, 2, 3, 0}), 1U);
  // Damaged distances must not silently be read as a picture. Zeros do not count as damage.
  for (const std::vector<double>& damaged :
       {std::vector<double>{0, 1, 2, 1, 0, 3, 2, 4, 0}, {0, .5, -.5, .5, 0, .25, -.5, .25, 0}})
    bad_data([&] { kind("(3, 3)", damaged); });
  EXPECT_EQ(kind("(3, 3)", {0, -2e-16, 1, -2e-16, 0, 1, 1, 1, 0}), 1U);
  const std::vector<double> few = {0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0};
  const ReadOptions rips{.array = ArrayMeaning::rips};
  EXPECT_EQ(any(npy("(4, 4)", few)).data.index(), 3U);
  EXPECT_EQ(any(npy("(4, 4)", few), rips).data.index(), 1U);
  const std::vector<double> uneven = {0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0};
  EXPECT_TRUE(says(any(npy("(4, 4)", uneven)), "format distance"));
  EXPECT_TRUE(contains(bad_data([&] { any(npy("(4, 4)", uneven), rips); }), "asymmetric"));
  EXPECT_EQ(kind("(3, 3)", {0, 0, 0, 0, 0, 0, 0, 0, 0}), 3U);
  bad_data([&] { kind("(3, 3)", {1, .1, .2, .1, 1, .3, .2, .3, 1}); });
  EXPECT_EQ(any(npy("(5,)", {1, 2, 3, 4, 5})).description, "signal of 5 values, NPY");
}

}  // namespace
}  // namespace ph::test
