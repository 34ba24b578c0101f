// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <thread>

#include "ph/io/read.hpp"
#include "tests/libph/io/images/nifti_file.hpp"
#include "tests/libph/io/read_support.hpp"

namespace ph::test {
namespace {

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
  EXPECT_TRUE(std::isnan(image_of(holes, "a.nii", {.nan = NanPolicy::drop}).values[5]));
  Nifti extended{.offset = 368};
  const std::string header = extended.header() + std::string(16, 'e');
  EXPECT_EQ(image_of(header + std::string(12, '\1'), "a.nii").values[0], 257);
}

TEST(ReadNifti, StatesThePlacesOfTheVoxels) {
  const auto affine_of = [](const Nifti& n, auto&& change) {
    std::string bytes = n.with(std::vector<std::int16_t>{0, 10, 1, 11, 2, 12});
    change([&](std::size_t at, auto value) { n.put(bytes, at, value); });
    return read_any(Input::hold({bytes.begin(), bytes.end()}, "a.nii"), Format::nifti).affine;
  };
  for (const bool big : {false, true}) {
    const Nifti n{.big = big};
    // Without a code, only the sizes of the voxels are known. The image has no third axis.
    EXPECT_EQ(affine_of(n,
                        [](auto&& put) {
                          put(80, 0.5F);
                          put(84, 2.F);
                        }),
              (Affine{{{0.5, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 1, 0}}}));
    // A turn by a right angle about the third axis: a = d = sqrt(1/2).
    const auto turned = [](float handedness) {
      return [handedness](auto&& put) {
        put(252, std::int16_t{1});
        put(76, handedness);
        for (std::size_t k = 0; k < 3; ++k) {
          put(80 + 4 * k, static_cast<float>(k + 2));
          put(268 + 4 * k, static_cast<float>(10 * k));
        }
        put(264, std::sqrt(0.5F));
      };
    };
    for (const float handedness : {1.F, 0.F, -1.F}) {
      const auto found = affine_of(n, turned(handedness));
      const double z = handedness < 0 ? -4 : 4;
      const Affine expected{{{0, -3, 0, 0}, {2, 0, 0, 10}, {0, 0, z, 20}}};
      ASSERT_TRUE(found.has_value());
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR((*found)[r][k], expected[r][k], 1e-6);
    }
    // The rows of method 3 come first.
    const auto rows = [&](float last) {
      return affine_of(n, [&](auto&& put) {
        turned(1)(put);
        put(254, std::int16_t{2});
        for (std::size_t i = 0; i < 12; ++i)
          put(280 + 4 * i, i == 11 ? last : static_cast<float>(i));
      });
    };
    EXPECT_EQ(rows(11), (Affine{{{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10, 11}}}));
    EXPECT_EQ(rows(std::nanf("")), std::nullopt);
  }
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
  // Memory is needed for the stored numbers and for the result. Doubles are scaled in place.
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
    if (progress.done == progress.total)  // everything has been read, and only scaling is left
      source.request_stop();
    else
      // Reports are at least 100 ms apart.
      std::this_thread::sleep_for(std::chrono::milliseconds(101));
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

}  // namespace
}  // namespace ph::test
