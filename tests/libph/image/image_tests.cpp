// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "ph/eigen.hpp"
#include "ph/error.hpp"
#include "ph/persistence.hpp"
#include "ph/voxel_image.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph {
namespace {

Points random_points(std::mt19937& random, Index rows, Index cols) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Points points(rows, cols);
  for (double& x : points.coordinates()) x = uniform(random);
  return points;
}

/// The centre of voxel i.
Eigen::RowVectorXd centre(const PointImage& image, Index i) {
  const auto d = static_cast<Index>(image.first.size());
  Eigen::RowVectorXd x(d);
  for (Index k = d - 1; k >= 0; --k) {
    const Index extent = image.image.extents[static_cast<std::size_t>(k)];
    x[k] = image.first[static_cast<std::size_t>(k)] + static_cast<double>(i % extent) * image.voxel;
    i /= extent;
  }
  return x;
}

// For any memory layout, the image of an array equals the image that a loop over the elements
// gives. An array in C order is not copied.
TEST(ImageOfArray, TakesAnyLayout) {
  std::mt19937 random(5);
  int borrowed = 0, copied = 0;
  for (int round = 0; round < 400; ++round) {
    const std::size_t axes = 1 + random() % 4;
    std::vector<Index> extents(axes);
    for (Index& n : extents) n = static_cast<Index>(random() % 4) + (round % 5 == 0 ? 0 : 1);
    // The axes are nested in any order, with gaps and reversed directions.
    std::vector<std::size_t> nesting(axes);
    std::iota(nesting.begin(), nesting.end(), 0U);
    if (round % 2 == 0) std::shuffle(nesting.begin(), nesting.end(), random);
    std::vector<std::ptrdiff_t> strides(axes);
    std::ptrdiff_t stride = 1, first = 0;
    for (auto k = nesting.rbegin(); k != nesting.rend(); ++k) {
      const Index n = std::max<Index>(extents[*k], 1);
      const bool backwards = round % 2 == 0 && random() % 3 == 0;
      strides[*k] = backwards ? -stride : stride;
      if (backwards) first += (n - 1) * stride;
      stride *= n + (round % 2 == 0 ? static_cast<Index>(random() % 2) : 0);
    }
    std::vector<std::int16_t> array(static_cast<std::size_t>(stride));
    for (std::int16_t& x : array) x = static_cast<std::int16_t>(random());
    const auto before = array;
    const Image image = image_of_array(VoxelType::int16, array.data() + first, extents, strides);
    EXPECT_EQ(image.extents, extents);
    std::vector<double> expected;
    std::vector<Index> at(axes, 0);
    const auto visit = [&](auto&& self, std::size_t k, std::ptrdiff_t place) -> void {
      if (k == axes) return expected.push_back(array[static_cast<std::size_t>(place)]);
      for (Index i = 0; i < extents[k]; ++i) self(self, k + 1, place + i * strides[k]);
    };
    visit(visit, 0, first);
    EXPECT_EQ(image.values.doubles(), expected);
    (image.values.is_borrowed() ? borrowed : copied) += 1;
    if (image.values.is_borrowed()) {
      EXPECT_EQ(image.values.data(), array.data() + first);
      EXPECT_EQ(image.values.bytes(), 0U);
      EXPECT_FALSE(image.values.is_in_file());
    }
    if (expected.empty()) continue;
    // Operations on the image do not change the array.
    Image changed = image;
    changed.values.change([](auto& all) { all[0] = 7; });
    const Cubical cubical(image, {.superlevel = true});
    const Barcode bars = persistence(cubical, {.representatives = Representatives::none});
    EXPECT_EQ(bars.size(),
              persistence(Cubical(Image{extents, expected}, {.superlevel = true})).size());
    EXPECT_EQ(array, before);
  }
  EXPECT_GT(borrowed, 100);
  EXPECT_GT(copied, 100);
}

TEST(ImageOfArray, KeepsItsOwner) {
  auto owner = std::make_shared<std::vector<double>>(std::vector<double>{3, 1, 2});
  Image image = image_of_array(VoxelType::float64, owner->data(), {3}, {}, owner);
  EXPECT_EQ(owner.use_count(), 2);
  {
    const Cubical cubical(image);
    image = {};
    EXPECT_EQ(owner.use_count(), 2) << "the complex reads it";
    EXPECT_EQ(persistence(cubical).size(), 1U);
  }
  EXPECT_EQ(owner.use_count(), 1);
}

TEST(ImageOfArray, OfOddAddressesIsCopied) {
  const float numbers[] = {0.5F, -2, 7};
  std::vector<char> bytes(sizeof numbers + 1);
  std::memcpy(bytes.data() + 1, numbers, sizeof numbers);
  const Image image = image_of_array(VoxelType::float32, bytes.data() + 1, {3});
  EXPECT_FALSE(image.values.is_borrowed());
  EXPECT_EQ(image.values, (Voxels{0.5, -2, 7}));
}

TEST(ImageOfArray, SaysWhatIsWrong) {
  const double number = 1;
  const std::ptrdiff_t stride = 1;
  const auto fails = [&](std::vector<Index> extents, std::span<const std::ptrdiff_t> strides,
                         const std::string& words) {
    test::expect_error(ErrorKind::usage, words,
                       [&] { image_of_array(VoxelType::float64, &number, extents, strides); });
  };
  fails({-1}, {}, "found extents [-1]");
  fails({1, 1}, {&stride, 1}, "found 1 strides, expected 2");
  fails({Index{1} << 40, Index{1} << 40}, {}, "expected a product of at most");
}

TEST(VoxelImage, IsTheDistanceToTheNearestOccupiedVoxel) {
  std::mt19937 random(3);
  for (int round = 0; round < 60; ++round) {
    const Index cols = 1 + round % 4;
    const Points points = random_points(random, 1 + round % 13, cols);
    const double voxel = cols == 4 ? 0.4 : 0.15;
    const PointImage image = voxel_image(points, voxel, VoxelValue::distance, round % 3);
    std::vector<Index> occupied;
    const auto size = static_cast<Index>(image.image.values.size());
    for (Index i = 0; i < size; ++i)
      if (image.image.values[static_cast<std::size_t>(i)] == 0) occupied.push_back(i);
    // Checks that each point lies in an occupied voxel, and that each occupied voxel contains a
    // point.
    const auto has = [&](Index i, Index p) {
      return ((as_matrix(points).row(p) - centre(image, i)).cwiseAbs().array() <=
              0.5 * voxel + 1e-12)
          .all();
    };
    for (Index p = 0; p < points.rows(); ++p)
      EXPECT_TRUE(std::ranges::any_of(occupied, [&](Index i) { return has(i, p); }));
    for (const Index i : occupied) {
      bool found = false;
      for (Index p = 0; p < points.rows(); ++p) found = found || has(i, p);
      EXPECT_TRUE(found);
    }
    for (Index i = 0; i < size; ++i) {
      double nearest = kInfinity;
      for (const Index j : occupied)
        nearest = std::min(nearest, (centre(image, i) - centre(image, j)).norm());
      ASSERT_NEAR(image.image.values[static_cast<std::size_t>(i)], nearest, 1e-12);
    }
  }
}

TEST(VoxelImage, CountsPointsAndTellsWhereTheyAre) {
  // The first of three voxels contains two points, the second contains none, and the third contains
  // one.
  const Points points{{0.1}, {0.9}, {2.5}};
  const auto values = [&](VoxelValue value) {
    const PointImage image = voxel_image(points, 1, value, 0);
    EXPECT_EQ(image.image.extents, std::vector<Index>{3});
    EXPECT_NEAR(image.first[0], 0.6, 1e-12);
    return image.image.values;
  };
  EXPECT_EQ(values(VoxelValue::distance), (std::vector<double>{0, 1, 0}));
  for (const VoxelValue value : {VoxelValue::occupancy, VoxelValue::density}) {
    const bool is_count = value == VoxelValue::density;
    const Voxels found = values(value);
    EXPECT_EQ(found[0], is_count ? -2 : 0);
    EXPECT_TRUE(std::isnan(found[1])) << "a voxel without points is absent";
    EXPECT_EQ(found[2], is_count ? -1 : 0);
  }
  // Absent voxels do not join occupied voxels.
  const PointImage density = voxel_image(points, 1, VoxelValue::density);
  EXPECT_EQ(persistence(Cubical(density.image)).bars(0).size(), 2U);
}

/// The bars of a dimension that are longer than `length`.
std::vector<Bar> long_bars(const Barcode& barcode, int dim, double length) {
  std::vector<Bar> found;
  for (const Bar& bar : barcode.bars(dim))
    if (bar.death - bar.birth > length) found.push_back(bar);
  return found;
}

TEST(VoxelImage, HasTheHomologyOfTheShape) {
  std::mt19937 random(4);
  std::normal_distribution<double> gauss;
  constexpr double voxel = 0.1;
  Points sphere(3000, 3), circle(400, 3);
  for (Index i = 0; i < sphere.rows(); ++i)
    as_matrix(sphere).row(i) =
        Eigen::RowVector3d(gauss(random), gauss(random), gauss(random)).normalized();
  for (Index i = 0; i < circle.rows(); ++i) {
    const double a =
        static_cast<double>(i) * 2 * std::acos(-1.0) / static_cast<double>(circle.rows());
    circle.set_row(i, {std::cos(a), std::sin(a), 0});
  }
  CubicalOptions cells;
  cells.construction = CubicalOptions::Construction::cells;
  for (const auto& [points, dim] : {std::pair{sphere, 2}, std::pair{circle, 1}}) {
    const Barcode barcode = persistence(Cubical(voxel_image(points, voxel).image, cells));
    EXPECT_EQ(long_bars(barcode, 0, 0.4).size(), 1U);
    EXPECT_EQ(long_bars(barcode, 3 - dim, 0.4).size(), 0U);
    const std::vector<Bar> hollow = long_bars(barcode, dim, 0.4);
    ASSERT_EQ(hollow.size(), 1U);
    EXPECT_NEAR(hollow[0].death, 1, 2 * voxel);  // the radius of the sphere
  }
}

TEST(VoxelImage, RefusesWhatItCannotDo) {
  const Points two{{0, 0}, {1, 1}};
  const auto kind = [](auto&&... arguments) {
    try {
      voxel_image(arguments...);
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::internal;
  };
  for (const double voxel : {0.0, -1.0, kInfinity, std::nan("")})
    EXPECT_EQ(kind(two, voxel), ErrorKind::usage) << voxel;
  EXPECT_EQ(kind(two, 0.1, VoxelValue::density, Index{-1}), ErrorKind::usage);
  EXPECT_EQ(kind(Points(2, 9), 0.1), ErrorKind::usage);
  EXPECT_EQ(kind(Points(0, 2), 0.1), ErrorKind::bad_data);
  EXPECT_EQ(kind(two, 1e-6), ErrorKind::resource);
  Points hole = two;
  hole(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(kind(hole, 0.1), ErrorKind::bad_data);
  test::LimitedContext little(1000);
  EXPECT_EQ(kind(two, 0.01, VoxelValue::distance, Index{1}, little), ErrorKind::resource);
}

// The image is a single line. Processing the line takes as much memory as the image.
TEST(VoxelImage, CountsWhatALineTakes) {
  const Points ends{{0}, {1000}};
  const auto with_limit = [&](std::size_t bytes) {
    test::LimitedContext context(bytes);
    const std::size_t voxels =
        voxel_image(ends, 1, VoxelValue::distance, 0, context).image.values.size();
    EXPECT_EQ(context.memory.peak(), bytes);
    EXPECT_EQ(context.memory.used(), 0U);
    return voxels;
  };
  const std::size_t voxels = 1001, headers = 3 * 8, bytes = voxels * (8 + 24) + headers;
  EXPECT_EQ(with_limit(bytes), voxels);
  EXPECT_TRUE(test::fails_with(ErrorKind::resource, [&] { with_limit(bytes - 1); }));
}

TEST(VoxelImage, IsStoppedWithinALine) {
  const Points ends{{0}, {9}};
  test::StoppableContext context;
  context.on_progress = [&](const Progress& progress) {
    if (progress.done > 0 && progress.done < progress.total)
      context.request_stop();
    else
      // Reports are at least 100 ms apart.
      std::this_thread::sleep_for(std::chrono::milliseconds(101));
  };
  std::this_thread::sleep_for(std::chrono::milliseconds(101));
  EXPECT_TRUE(test::fails_with(ErrorKind::cancelled,
                               [&] { voxel_image(ends, 1, VoxelValue::distance, 0, context); }));
}

// ---- voxels

TEST(Voxels, AreEmptyWhenTheyWereMovedFrom) {
  Voxels from(std::vector<std::uint8_t>{1, 2, 3});
  const Voxels to = std::move(from);
  EXPECT_EQ(to.size(), 3U);
  const auto expect_empty = [](const Voxels& voxels) {
    EXPECT_EQ(voxels.size(), 0U);
    EXPECT_EQ(voxels.bytes(), 0U);
    EXPECT_EQ(voxels.type(), VoxelType::float64);
    EXPECT_TRUE(voxels.empty());
    EXPECT_TRUE(voxels.begin() == voxels.end());
    EXPECT_TRUE(voxels.doubles().empty());
    EXPECT_EQ(voxels.data(), nullptr);
    EXPECT_EQ(voxels, Voxels());
  };
  expect_empty(from);  // NOLINT(bugprone-use-after-move)
  expect_empty(Voxels());
  Voxels copy = from;
  expect_empty(copy);
  copy.change([](auto& all) { all.resize(2); });
  EXPECT_EQ(copy, (Voxels{0, 0}));
  expect_empty(from);
  from = to;
  EXPECT_EQ(from, to);

  Image image{{1, 3}, {1, 2, 3}};
  const Image other = std::move(image);
  EXPECT_EQ(other.values.size(), 3U);
  EXPECT_EQ(image.dim(), 0);  // NOLINT(bugprone-use-after-move)
  EXPECT_TRUE(image.values.empty());
  EXPECT_TRUE(persistence(Cubical(image)).empty());
}

TEST(Voxels, AreOfFiveTypes) {
  static_assert(std::is_convertible_v<std::vector<std::int16_t>, Voxels>);
  static_assert(!std::is_constructible_v<Voxels, std::vector<int>>);
  static_assert(!std::is_constructible_v<Voxels, std::vector<std::uint64_t>>);
  EXPECT_EQ(Voxels(std::vector<std::uint8_t>(2)).type(), VoxelType::uint8);
  EXPECT_EQ(Voxels(std::vector<std::uint16_t>(2)).type(), VoxelType::uint16);
  EXPECT_EQ(Voxels(std::vector<std::int16_t>(2)).type(), VoxelType::int16);
  EXPECT_EQ(Voxels(std::vector<float>(2)).type(), VoxelType::float32);
  EXPECT_EQ(Voxels(std::vector<double>(2)).type(), VoxelType::float64);
}

TEST(Voxels, AreChangedInPlaceByTheirOnlyOwner) {
  Voxels voxels{1, 2, 3};
  const void* const place = voxels.data();
  {
    const Voxels copy = voxels;
    EXPECT_EQ(copy.data(), place) << "copies share";
  }
  voxels.change([](auto& all) { all[0] = 9; });
  EXPECT_EQ(voxels.data(), place);
  const Voxels copy = voxels;
  voxels.change([](auto& all) { all[0] = 5; });
  EXPECT_NE(voxels.data(), copy.data());
  EXPECT_EQ(copy, (Voxels{9, 2, 3}));
  EXPECT_EQ(voxels, (Voxels{5, 2, 3}));
}

// Each of two threads has its own copy of the voxels, and does not see changes by the other thread.
// The second thread waits until the first thread has made its change. After that, it is the only
// owner of the old numbers and changes them in place. Only the reference count orders these
// accesses (the flag does not), and ThreadSanitizer checks the order.
TEST(Voxels, AreChangedByThreadsWithACopyEach) {
  Voxels early{1, 2, 3}, late = early;
  const void* const place = late.data();
  std::atomic<bool> is_alone = false;
  std::thread first([&] {
    early.change([](auto& all) { all[0] = 7; });
    is_alone.store(true, std::memory_order_relaxed);
  });
  std::thread second([&] {
    while (!is_alone.load(std::memory_order_relaxed)) std::this_thread::yield();
    late.change([](auto& all) { all[0] = 9; });
  });
  first.join();
  second.join();
  EXPECT_EQ(late.data(), place);
  EXPECT_EQ(early, (Voxels{7, 2, 3}));
  EXPECT_EQ(late, (Voxels{9, 2, 3}));
}

}  // namespace
}  // namespace ph
