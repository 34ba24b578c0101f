// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "ph/io/read.hpp"
#include "tests/libph/io/read_support.hpp"
#include "tests/support/test_data.hpp"

namespace ph::test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr std::int64_t kHuge = std::int64_t{1} << 60;

std::string dipha(std::int64_t type, const std::vector<std::int64_t>& numbers,
                  const std::vector<double>& values = {}) {
  std::string bytes = le(std::int64_t{8067171840}) + le(type);
  for (const std::int64_t n : numbers) bytes += le(n);
  for (const double v : values) bytes += le(v);
  return bytes;
}
ReadResult any(const std::string& bytes, const ReadOptions& options = {}) {
  return read_any(Input::view(bytes, "a.dipha"), Format::automatic, options);
}
void expect_refused(const std::vector<std::string>& cases) {
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string message = bad_data([&] { any(cases[i]); });
    EXPECT_TRUE(contains(message, "a.dipha")) << i << message;
  }
}
void expect_whole_only(const std::string& bytes) {
  check_prefixes(
      bytes, "a.dipha", [](const Input& in) { read_any(in); }, never());
  EXPECT_TRUE(contains(bad_data([&] { any(bytes + "x"); }), "a.dipha: byte"));
}

TEST(ReadDipha, Images) {
  // x varies fastest. The value at (x, y) is 10 x + y.
  const std::string bytes = dipha(1, {6, 2, 2, 3}, {0, 10, 1, 11, 2, kInf});
  const ReadResult result = any(bytes);
  EXPECT_EQ(result.format, Format::dipha);
  EXPECT_EQ(result.description, "image of 2 x 3 voxels, DIPHA");
  const auto& image = std::get<Image>(result.data);
  EXPECT_EQ(image.extents, (std::vector<Index>{2, 3}));
  EXPECT_EQ(image.values, (std::vector<double>{0, 1, 2, 10, 11, kInf}));
  EXPECT_EQ(read_image(Input::view(bytes, "a")).values, image.values);
  expect_whole_only(bytes);
  expect_refused({dipha(1, {5, 2, 2, 3}, {0, 10, 1, 11, 2}), dipha(1, {1, 0}, {1}),
                  dipha(1, {1, -1}, {1}), dipha(1, {1, 1, -1}, {1}), dipha(1, {-1, 1, 1}, {1}),
                  dipha(1, {kHuge, 1, kHuge}, {1}), dipha(1, {1, kHuge, 1}, {1}),
                  dipha(1, {0, 4, kHuge, kHuge, kHuge, 2}), dipha(1, {0, 1, 0}),
                  dipha(1, {1, 1, 1}, {std::nan("")})});
  const ReadResult masked = any(dipha(1, {1, 1, 1}, {std::nan("")}), {.nan = NanPolicy::drop});
  EXPECT_TRUE(std::get<Image>(masked.data).masked);
  EXPECT_TRUE(std::isnan(std::get<Image>(masked.data).values[0]));
}

TEST(ReadDipha, DistanceMatrices) {
  const std::string bytes = dipha(7, {3}, {0, 1, 2, 1, 0, kInf, 2, kInf, 0});
  const ReadResult result = any(bytes);
  EXPECT_EQ(result.description, "distances of 3 points, DIPHA");
  const auto& d = std::get<DistanceMatrix>(result.data);
  EXPECT_EQ(d(1, 0), 1);
  EXPECT_EQ(d(2, 0), 2);
  EXPECT_EQ(d(2, 1), kInf);
  EXPECT_EQ(read_distances(Input::view(bytes, "a"))(2, 0), 2);
  expect_whole_only(bytes);
  expect_refused({dipha(7, {2}, {0, 1, 2, 0}), dipha(7, {2}, {0, -1, -1, 0}),
                  dipha(7, {2}, {1, 1, 1, 0}), dipha(7, {-1}), dipha(7, {kHuge}, {0}),
                  dipha(7, {std::int64_t{1} << 32}, {0}), dipha(7, {0}),
                  dipha(7, {2}, {0, std::nan(""), 1, 0})});
  const auto larger = any(dipha(7, {2}, {0, 1, 2, 0}), {.symmetrise = Symmetrise::max});
  EXPECT_EQ(std::get<DistanceMatrix>(larger.data)(1, 0), 2);
}

TEST(ReadDipha, SparseDistanceMatrices) {
  // The data have the form that DIPHA's tool writes: each pair is listed at both of its points, and
  // each point has an entry for itself with distance 0.
  const std::string bytes = dipha(8, {3, 2, 1, 0, 0, 1, 0}, {0, 1.5, 1.5});
  const ReadResult result = any(bytes);
  const auto& sparse = std::get<SparseDistances>(result.data);
  EXPECT_EQ(sparse.size(), 3);
  EXPECT_EQ(sparse.edges(), (std::vector<WeightedEdge>{{0, 1, 1.5}}));
  EXPECT_EQ(result.description, "1 distances of 3 points, DIPHA");
  EXPECT_EQ(read_sparse(Input::view(bytes, "a")).size(), 3);
  expect_whole_only(bytes);
  expect_refused({dipha(8, {2, 1, 1, 1, 0}, {1, 2}), dipha(8, {2, 1, 0, 2}, {1}),
                  dipha(8, {2, 1, 0, -1}, {1}), dipha(8, {2, 1, 0, 1}, {-1}),
                  dipha(8, {2, 1, 0, 0}, {1}), dipha(8, {2, 1, 0, 1}, {std::nan("")}),
                  dipha(8, {2, -1, 2, 1}, {1}), dipha(8, {2, kHuge, 1, 1}, {1}), dipha(8, {0}),
                  dipha(8, {kHuge}), dipha(8, {std::int64_t{1} << 40, 0})});
}

TEST(ReadDipha, RoundingOnTheDiagonalOfASparseMatrix) {
  const auto read = [](double diagonal) {
    return std::get<SparseDistances>(any(dipha(8, {2, 2, 0, 0, 1}, {diagonal, 1.5})).data);
  };
  EXPECT_EQ(read(1e-9).edges(), (std::vector<WeightedEdge>{{0, 1, 1.5}}));
  EXPECT_TRUE(contains(bad_data([&] { read(1e-5); }), "non-zero diagonal, distance of 0 and 0"));
}

TEST(ReadDipha, BoundaryMatrices) {
  const std::string head = dipha(0, {0, 3, 1, 0, 0, 1}, {0, 0.5, 2});
  const auto rest = [](const std::vector<std::int64_t>& numbers) {
    return dipha(0, numbers).substr(16);
  };
  const std::string bytes = head + rest({0, 0, 0, 2, 1, 0});
  const ReadResult result = any(bytes);
  EXPECT_EQ(result.description, "boundary matrix of 3 cells, DIPHA");
  const auto& b = std::get<BoundaryInput>(result.data);
  EXPECT_EQ(b.matrix.dims, (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(b.matrix.values, (std::vector<double>{0, 0.5, 2}));
  EXPECT_EQ(b.matrix.offsets, (std::vector<std::size_t>{0, 0, 0, 2}));
  EXPECT_EQ(b.matrix.rows, (std::vector<Index>{0, 1}));
  EXPECT_EQ(b.namer()(1), "a.dipha: byte 48 (cell 1)");
  EXPECT_EQ(read_phat(Input::view(bytes, "a")).matrix.values[1], 0.5);
  expect_whole_only(bytes);
  expect_refused({head + rest({0, 0, 0, 2, 0, 3}), head + rest({0, 0, 0, 2, 0, -1}),
                  head + rest({0, 0, 0, 2, 1, 1}), head + rest({0, 0, 3, 2, 0, 1}),
                  head + rest({0, 1, 0, 2, 0, 1}), head + rest({1, 1, 1, 2, 0, 1}),
                  head + rest({0, 0, 0, -1}), head + rest({0, 0, 0, kHuge}), dipha(0, {2, 0, 0}),
                  dipha(0, {0, -1, 0}), dipha(0, {0, kHuge, 0}), dipha(0, {0, 0, 0, 0}),
                  dipha(0, {0, 0, 0, 1, 0}), dipha(0, {0, 1, 0, 1}, {0}) + rest({0, 0}),
                  dipha(0, {0, 1, -1, 0}, {0}) + rest({0, 0}),
                  dipha(0, {0, 1, 0, 0}, {std::nan("")}) + rest({0, 0})});
  EXPECT_TRUE(contains(bad_data([&] { any(dipha(0, {1, 3, 1})); }), "dualised"));
}

TEST(ReadDipha, SaysWhatItIsNot) {
  EXPECT_TRUE(contains(bad_data([&] { any(dipha(2, {0})); }), "persistence diagram"));
  EXPECT_TRUE(contains(bad_data([&] { any(dipha(3, {0})); }), "byte 8: DIPHA file type, found 3"));
  EXPECT_TRUE(contains(bad_data([&] { read_image(Input::view(dipha(7, {0}), "a")); }),
                       "found a distance matrix, expected an image"));
  const std::string text = "not DIPHA at all";
  EXPECT_TRUE(contains(bad_data([&] { read_any(Input::view(text, "a.dipha"), Format::dipha); }),
                       "not a DIPHA file"));
}

TEST(ReadDipha, ReadsWhatNpyReads) {
  const auto folder = test_data("cases/in");
  if (folder.empty()) GTEST_SKIP() << no_test_data("cases/in");
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".npy") continue;
    const Image image = read_image(entry.path());
    std::vector<std::int64_t> numbers{static_cast<std::int64_t>(image.values.size()), image.dim()};
    numbers.insert(numbers.end(), image.extents.rbegin(), image.extents.rend());
    // If the axes are reversed, x varies fastest in C order.
    const Image back = read_image(Input::view(dipha(1, numbers, image.values.doubles()), "a"));
    ASSERT_EQ(back.dim(), image.dim());
    EXPECT_TRUE(std::equal(back.extents.rbegin(), back.extents.rend(), image.extents.begin()));
    double sum = 0, expected = 0;
    for (const double v : back.values) sum += v;
    for (const double v : image.values) expected += v;
    EXPECT_NEAR(sum, expected, 1e-9 * (1 + std::abs(expected)));
  }
}

}  // namespace
}  // namespace ph::test
