// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

#include "ph/persistence.hpp"
#include "ph/ph.h"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/random_images.hpp"

namespace ph::test {
namespace {

ph_options defaults() {
  ph_options options;
  ph_options_init(&options);
  return options;
}

/// Compares all bars and their cells. Reads `found` only through the C interface.
void expect_same(ph_barcode* found, const Barcode& expected) {
  ASSERT_EQ(ph_barcode_size(found), expected.size());
  const ph_bar* bars = ph_barcode_bars(found);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ((Bar{bars[i].dim, bars[i].birth, bars[i].death}), expected[i]);
    const std::int64_t* numbers = nullptr;
    const std::size_t birth = ph_barcode_birth_cell(found, i, &numbers);
    EXPECT_TRUE(std::ranges::equal(std::span(numbers, birth), expected.birth_cell(i).numbers));
    const std::size_t death = ph_barcode_death_cell(found, i, &numbers);
    ASSERT_EQ(death > 0, expected.death_cell(i).has_value());
    if (death == 0) continue;
    EXPECT_TRUE(std::ranges::equal(std::span(numbers, death), expected.death_cell(i)->numbers));
  }
  EXPECT_EQ(ph_barcode_birth_cell(found, expected.size(), nullptr), 0U);
  ph_barcode_free(found);
}

TEST(CInterface, GivesTheBarsOfPoints) {
  for_each_seed(200, [](Generator& random, bool ties, std::int64_t field) {
    const Points points = random.points(random.integer(0, 9), random.integer(0, 3), ties);
    ph_options options = defaults();
    options.field = field;
    options.max_dim = random.integer(-1, 2);
    options.distance = random.coin() ? PH_EUCLIDEAN : PH_MANHATTAN;
    RipsOptions rips{.distance = static_cast<PointDistance>(options.distance)};
    if (random.coin()) rips.threshold = options.threshold = random.value(ties);
    Options task{.field = field};
    if (options.max_dim >= 0) task.max_dim = options.max_dim;
    // Stores the numbers column by column, as in Fortran and Julia.
    std::vector<double> by_columns;
    for (Index k = 0; k < points.cols(); ++k)
      for (Index i = 0; i < points.rows(); ++i) by_columns.push_back(points(i, k));
    ph_barcode* bars = nullptr;
    ASSERT_EQ(ph_rips_points(by_columns.data(), points.rows(), points.cols(), 1, points.rows(),
                             &options, &bars),
              PH_OK);
    rips.merge_equal_points = false;
    const Barcode of_all = persistence(Rips(points, rips), task);
    rips.merge_equal_points = std::nullopt;
    const Barcode expected = persistence(Rips(points, rips), task);
    ASSERT_EQ(expected.size(), of_all.size());
    for (std::size_t i = 0; i < of_all.size(); ++i) EXPECT_EQ(expected[i], of_all[i]);
    expect_same(bars, expected);
  });
}

TEST(CInterface, GivesTheBarsOfDistancesAndImages) {
  const std::vector<double> lower{1, 2, 1, 1, 2, 1};
  ph_barcode* bars = nullptr;
  ASSERT_EQ(ph_rips_distances(lower.data(), 4, nullptr, &bars), PH_OK);
  expect_same(bars, persistence(Rips(DistanceMatrix(4, lower))));
  for_each_seed(200, [](Generator& random, bool ties, std::int64_t field) {
    std::vector<std::int64_t> extents;
    std::size_t count = 1;
    for (int k = random.integer(1, 3); k > 0; --k) {
      extents.push_back(random.integer(1, 5));
      count *= static_cast<std::size_t>(extents.back());
    }
    std::vector<float> values(count);
    for (float& v : values) v = static_cast<float>(random.value(ties));
    ph_options options = defaults();
    options.field = field;
    options.superlevel = random.coin() ? 1 : 0;
    options.construction = random.coin() ? PH_CELLS : PH_VERTICES;
    const std::vector<std::uint8_t> periodic(extents.size(), random.coin() ? 1 : 0);
    options.periodic = periodic.data();
    ph_barcode* found = nullptr;
    ASSERT_EQ(ph_cubical_image(values.data(), PH_FLOAT32, static_cast<int>(extents.size()),
                               extents.data(), nullptr, &options, &found),
              PH_OK)
        << ph_last_error();
    // The numbers are stored in reverse order and read with negative strides.
    std::vector<float> reversed(values.rbegin(), values.rend());
    std::vector<std::int64_t> strides(extents.size(), -1);
    for (std::size_t k = extents.size() - 1; k > 0; --k) strides[k - 1] = strides[k] * extents[k];
    ph_barcode* again = nullptr;
    ASSERT_EQ(ph_cubical_image(&reversed.back(), PH_FLOAT32, static_cast<int>(extents.size()),
                               extents.data(), strides.data(), &options, &again),
              PH_OK)
        << ph_last_error();
    CubicalOptions cubes{.construction = options.construction == PH_CELLS
                                             ? CubicalOptions::Construction::cells
                                             : CubicalOptions::Construction::vertices,
                         .superlevel = options.superlevel != 0,
                         .periodic = std::vector<bool>(extents.size(), periodic[0] != 0)};
    expect_same(found, persistence(Cubical(Image{extents, values}, cubes), {.field = field}));
    expect_same(again, persistence(Cubical(Image{extents, values}, cubes), {.field = field}));
  });
}

TEST(CInterface, TakesManyAtATime) {
  Generator random(7);
  std::vector<Points> clouds;
  std::vector<std::vector<float>> images;
  for (int i = 0; i < 60; ++i) {
    clouds.push_back(random.points(random.integer(0, 9), 2, i % 2 == 0));
    images.emplace_back(20);
    for (float& v : images.back()) v = static_cast<float>(random.value(i % 2 == 0));
  }
  std::vector<const double*> begins;
  std::vector<std::int64_t> rows;
  for (Points& cloud : clouds) {
    begins.push_back(cloud.rows() == 0 ? nullptr : &cloud(0, 0));
    rows.push_back(cloud.rows());
  }
  std::vector<const void*> voxels;
  for (const auto& image : images) voxels.push_back(image.data());
  for (const int threads : {1, 2, 4}) {
    ph_options options = defaults();
    options.threads = threads;
    options.cancel = threads == 2 ? [](void*) { return 0; } : ph_cancel{};
    std::vector<ph_barcode*> bars(clouds.size());
    ASSERT_EQ(
        ph_rips_points_batch(begins.data(), rows.data(), 2, bars.size(), &options, bars.data()),
        PH_OK)
        << ph_last_error();
    for (std::size_t i = 0; i < bars.size(); ++i)
      expect_same(bars[i], persistence(Rips(clouds[i], {.merge_equal_points = true})));
    const std::int64_t extents[] = {4, 5};
    ASSERT_EQ(ph_cubical_image_batch(voxels.data(), PH_FLOAT32, 2, extents, bars.size(), &options,
                                     bars.data()),
              PH_OK)
        << ph_last_error();
    for (std::size_t i = 0; i < bars.size(); ++i)
      expect_same(bars[i], persistence(Cubical(Image{{4, 5}, images[i]})));
  }
  // A call that fails returns no barcodes, and names the input that failed.
  std::vector<ph_barcode*> none(clouds.size(), nullptr);
  images[42][3] = std::nanf("");
  const std::int64_t extents[] = {4, 5};
  EXPECT_EQ(ph_cubical_image_batch(voxels.data(), PH_FLOAT32, 2, extents, none.size(), nullptr,
                                   none.data()),
            PH_BAD_DATA);
  EXPECT_EQ(std::strstr(ph_last_error(), "input 42: "), ph_last_error()) << ph_last_error();
  EXPECT_EQ(ph_rips_points_batch(nullptr, rows.data(), 2, 2, nullptr, none.data()), PH_USAGE);
  EXPECT_EQ(ph_rips_points_batch(begins.data(), rows.data(), 2, 2, nullptr, nullptr), PH_USAGE);
  EXPECT_EQ(ph_cubical_image_batch(nullptr, PH_FLOAT32, 2, extents, 2, nullptr, none.data()),
            PH_USAGE);
  EXPECT_EQ(ph_rips_points_batch(nullptr, nullptr, 2, 0, nullptr, none.data()), PH_OK);
  EXPECT_EQ(ph_rips_points_batch(begins.data(), rows.data(), 2, SIZE_MAX, nullptr, none.data()),
            PH_RESOURCE);
  for (const ph_barcode* bars : none) EXPECT_EQ(bars, nullptr);
}

// Each pair of these points would be an edge: there would be 2e10 edges.
TEST(CInterface, TakesManyEqualPoints) {
  constexpr std::int64_t rows = 200'000;
  const double point[] = {1, 2, 3};
  ph_options options = defaults();
  options.memory_limit = std::uint64_t{4} << 30;
  for (const std::int64_t columns : {0, 3})
    for (const int max_dim : {0, 1}) {
      options.max_dim = max_dim;
      ph_barcode* bars = nullptr;
      ASSERT_EQ(ph_rips_points(point, rows, columns, 0, 1, &options, &bars), PH_OK)
          << ph_last_error();
      ASSERT_EQ(ph_barcode_size(bars), 1U);
      ph_barcode_free(bars);
    }
}

TEST(CInterface, SaysWhatIsWrong) {
  const double points[] = {0, 1, std::nan("")};
  ph_barcode* bars = nullptr;
  const auto expect = [&](ph_status expected, ph_status found, const char* words) {
    EXPECT_EQ(found, expected) << words;
    EXPECT_NE(std::strstr(ph_last_error(), words), nullptr) << ph_last_error();
    EXPECT_EQ(bars, nullptr);
  };
  expect(PH_BAD_DATA, ph_rips_points(points, 3, 1, 1, 1, nullptr, &bars), "point 2");
  expect(PH_USAGE, ph_rips_points(nullptr, 3, 1, 1, 1, nullptr, &bars), "data");
  expect(PH_USAGE, ph_rips_points(points, -1, 1, 1, 1, nullptr, &bars), "found -1 rows");
  expect(PH_USAGE, ph_rips_points(points, 2, 1, 1, 1, nullptr, nullptr), "out");
  expect(PH_USAGE, ph_rips_distances(points, -1, nullptr, &bars), "found -1 points");
  const std::int64_t extents[] = {3}, huge[] = {INT64_MAX};
  expect(PH_BAD_DATA, ph_cubical_image(points, PH_FLOAT64, 1, extents, nullptr, nullptr, &bars),
         "nan");
  expect(PH_USAGE, ph_cubical_image(points, PH_FLOAT64, 9, extents, nullptr, nullptr, &bars),
         "axes");
  expect(PH_USAGE, ph_cubical_image(points, PH_FLOAT64, 1, huge, nullptr, nullptr, &bars),
         "extent 0");
  expect(PH_USAGE,
         ph_cubical_image(points, static_cast<ph_number>(7), 1, extents, nullptr, nullptr, &bars),
         "ph_number");
  const auto with = [&](auto&& change) {
    ph_options options = defaults();
    change(options);
    return ph_rips_points(points, 2, 1, 1, 1, &options, &bars);
  };
  expect(PH_USAGE, with([](auto& o) { o.field = 4; }), "4");
  expect(PH_USAGE, with([](auto& o) { o.max_dim = -2; }), "max_dim");
  expect(PH_USAGE, with([](auto& o) { o.min_dim = -1; }), "-1");
  expect(PH_USAGE, with([](auto& o) { o.threads = -1; }), "threads");
  expect(PH_USAGE, with([](auto& o) { o.distance = 6; }), "distance");
  expect(PH_USAGE, with([](auto& o) { o.size += 1; }), "size");
  expect(PH_USAGE, with([](auto& o) { o.size = 0; }), "size");
  // The caller was compiled with an older header, in which the struct has only the first members.
  EXPECT_EQ(with([](auto& o) {
              o.distance = 6;
              o.size = offsetof(ph_options, distance);
            }),
            PH_OK);
  ph_barcode_free(bars);
  ph_barcode_free(nullptr);
  EXPECT_EQ(ph_barcode_size(nullptr), 0U);
  EXPECT_EQ(ph_abi_version(), PH_ABI_VERSION);
}

TEST(CInterface, StopsAndKeepsTheLimit) {
  std::vector<double> points(9000);
  Generator random(1);
  for (double& x : points) x = random.real();
  ph_options options = defaults();
  options.max_dim = 3;
  options.memory_limit = 1 << 20;
  ph_barcode* bars = nullptr;
  EXPECT_EQ(ph_rips_points(points.data(), 3000, 3, 3, 1, &options, &bars), PH_RESOURCE);
  options.memory_limit = 0;
  struct Caller {
    std::thread::id thread = std::this_thread::get_id();
    int calls = 0;
  } caller;
  options.cancel_user = &caller;
  options.cancel = [](void* user) {
    auto& c = *static_cast<Caller*>(user);
    EXPECT_EQ(c.thread, std::this_thread::get_id());
    return ++c.calls >= 3 ? 1 : 0;
  };
  EXPECT_EQ(ph_rips_points(points.data(), 3000, 3, 3, 1, &options, &bars), PH_CANCELLED);
  EXPECT_GE(caller.calls, 3);
  EXPECT_EQ(bars, nullptr);
}

}  // namespace
}  // namespace ph::test
