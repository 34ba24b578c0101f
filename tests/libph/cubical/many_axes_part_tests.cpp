// SPDX-License-Identifier: MIT
// Images with more than three axes, in parts that are computed independently and joined in random
// groups. Compares the components, and the bars of the second-highest dimension, with the result of
// one process.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "ph/detail/core/sealed_part.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/image_cases.hpp"

namespace ph::test {
namespace {

using Construction = CubicalOptions::Construction;

std::vector<Pair> pairs_of_one_process(const ImageCase& c, Engine engine) {
  return pairs_of(persistence(Cubical(c.image, c.options.cubical),
                              {.max_dim = c.options.max_dim.value_or(c.image.dim()),
                               .min_dim = c.options.min_dim,
                               .engine = engine}));
}

TEST(ManyAxesPart, AgreesWithTheOracleCellByCell) {
  std::size_t pieces = 0, highest = 0, of_many = 0;
  for_each_seed(3000, [&](Generator& random) {
    const ImageCase c = random_case_of_many_axes(random);
    const KeptAxes kept = kept_axes(c.image.extents, c.options.cubical);
    if (kept.count < 2) return;
    const bool is_small = c.image.values.size() <= 64;
    const auto expected = pairs_of_one_process(c, is_small ? Engine::standard : Engine::gradient);
    for (int count = 1; count <= c.layers; ++count) {
      RunContext context;
      context.slab_layers = random.integer(0, 2);
      context.threads = random.integer(1, 2);
      const ImagePart whole = joined(random, parts_of(c.image, count, c.options, context));
      ASSERT_TRUE(whole.is_whole());
      ASSERT_EQ(pairs_of(whole.barcode()), expected) << count << " parts";
    }
    (c.options.min_dim > 0 ? highest : pieces) += expected.size();
    of_many += kept.count > 3 ? 1 : 0;
  });
  EXPECT_TRUE(is_enough(pieces, std::size_t{1000})) << pieces;
  EXPECT_TRUE(is_enough(highest, std::size_t{300})) << highest;
  EXPECT_TRUE(is_enough(of_many, std::size_t{1500})) << of_many;
}

// The bytes of a part are the same, however the voxels are divided among threads.
TEST(ManyAxesPart, AgreesOnLargerImages) {
  std::size_t bars = 0;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    SCOPED_TRACE(seed);
    Generator random(seed);
    ImageCase c{random.image({9, 9, 10, 11}, seed % 4 < 2), {}, 9};
    if (seed % 2 == 0) c.options.cubical.construction = Construction::cells;
    if (seed < 8) {
      c.options.max_dim = 0;
      c.options.cubical.periodic = {seed < 4, false, true, false};
    } else {
      c.options.min_dim = 3;
    }
    const auto expected = pairs_of_one_process(c, Engine::gradient);
    bars += expected.size();
    RunContext threads;  // each thread takes a few thousand voxels at a time
    threads.threads = 3;
    for (const int count : {1, 4, 9}) {
      auto parts = parts_of(c.image, count, c.options, threads);
      ASSERT_EQ(parts[0].bytes(), ImagePart(c.image, 0, count, c.options).bytes());
      ASSERT_EQ(pairs_of(joined(random, std::move(parts)).barcode()), expected);
    }
  }
  EXPECT_GT(bars, 1000U);
}

TEST(ManyAxesPart, AgreesUpToEightAxes) {
  std::size_t bars = 0;
  for_each_seed(200, [&](Generator& random) {
    const int axes = random.integer(6, 8);
    std::vector<Index> extents{random.integer(2, 4)};
    while (static_cast<int>(extents.size()) < axes) extents.push_back(random.integer(1, 2));
    ImageCase c{random.image(extents, true), {.max_dim = 0}, static_cast<int>(extents[0])};
    c.options.cubical = random.cubical_options(axes);
    if (kept_axes(extents, c.options.cubical).count < 2) return;
    const auto expected = pairs_of_one_process(c, Engine::gradient);
    for (int count = 1; count <= c.layers; ++count)
      ASSERT_EQ(pairs_of(joined(random, parts_of(c.image, count, c.options)).barcode()), expected);
    bars += expected.size();
  });
  EXPECT_TRUE(is_enough(bars, std::size_t{200})) << bars;
}

// For the dimensions between the first and the last, all layers are needed at once. If these
// dimensions are requested, parts report an error instead of returning fewer bars.
TEST(ManyAxesPart, SaysWhatCanBeHad) {
  const auto refused = [](std::vector<Index> extents, ImagePartOptions options, const char* why) {
    Generator random(1);
    expect_error(ErrorKind::usage, why,
                 [&] { ImagePart(random.image(std::move(extents), true), 0, 1, options); });
  };
  refused(
      {2, 2, 2, 2}, {},
      "parts of an image of 4 axes: found a request for dimensions 0 to 3, expected dimension 0 "
      "alone, or 3 alone, because dimensions from 1 to 2 need all layers at once");
  refused({2, 2, 2, 2}, {.max_dim = 1},
          "found a request for dimensions 0 to 1, expected dimension 0 alone, or 3 alone");
  refused({2, 2, 2, 2}, {.min_dim = 2, .loops = true}, "expected dimension 0 alone, or 3 alone");
  refused({2, 2, 2, 2, 2}, {.min_dim = 3}, "dimension 0 alone, or 4 alone");
  refused({2, 2, 2, 2}, {.cubical = {.periodic = {false, true, false, false}}, .min_dim = 3},
          "dimension 0 alone in an image with a periodic axis");
  refused({2, 2, 2, 2, 1},
          {.cubical = {.periodic = {false, false, false, false, true}}, .min_dim = 3},
          "dimension 0 alone, or 4 alone");
}

TEST(ManyAxesPart, RefusesDamagedBytes) {
  for (const bool tops : {false, true}) {
    Generator random(3);
    const Image image = random.image({3, 2, 2, 2}, true);
    const ImagePartOptions options =
        tops ? ImagePartOptions{.min_dim = 3} : ImagePartOptions{.max_dim = 0};
    const std::vector<std::byte> bytes = ImagePart(image, 1, 3, options).bytes();
    const auto content = content_of_part(bytes, "image");
    std::size_t refused = 0;
    for (std::size_t i = 0; i < content.size(); ++i)
      for (const std::byte flipped : {std::byte{1}, std::byte{4}, std::byte{0x84}}) {
        std::vector<std::byte> damaged(content.begin(), content.end());
        damaged[i] ^= flipped;
        // Damaged bytes may be accepted as a part. Even then, joining this part must be safe: no
        // index may be out of range.
        try {
          ImagePart whole(image, 0, 3, options);
          whole.join(ImagePart::of_bytes(sealed_part("image", damaged)));
          whole.join(ImagePart(image, 2, 3, options));
          whole.barcode();
        } catch (const Error& error) {
          ASSERT_EQ(error.kind(), ErrorKind::bad_data) << error.what();
          ++refused;
        }
      }
    EXPECT_GT(refused, content.size() / 4);
  }
}

}  // namespace
}  // namespace ph::test
