// SPDX-License-Identifier: MIT
// Images in parts that are computed independently and joined in random groups: compares the results
// with the results of the whole images. Covers any number of parts, both constructions, holes,
// infinities, ties and periodic axes.
#include "ph/parts/image_part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include "libph/src/core/bytes/crc32.hpp"
#include "ph/detail/core/byte_writer.hpp"
#include "ph/detail/core/sealed_part.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/image_cases.hpp"

namespace ph::test {
namespace {

TEST(ImagePart, AgreesWithTheOracleCellByCell) {
  std::size_t bars = 0, refused = 0;
  for_each_seed(2000, [&](Generator& random) {
    const ImageCase c = random_image_case(random);
    if (is_refused(c)) {
      ++refused;
      return;
    }
    const Options oracle{.max_dim = c.options.max_dim.value_or(c.image.dim()),
                         .min_dim = c.options.min_dim,
                         .engine = Engine::standard};
    const auto expected = pairs_of(persistence(Cubical(c.image, c.options.cubical), oracle));
    for (int count = 1; count <= c.layers; ++count) {
      const ImagePart whole = joined(random, parts_of(c.image, count, c.options));
      ASSERT_TRUE(whole.is_whole());
      ASSERT_EQ(pairs_of(whole.barcode()), expected) << count << " parts";
    }
    bars += expected.size();
  });
  EXPECT_TRUE(is_enough(bars, std::size_t{3000})) << bars;
  EXPECT_TRUE(is_enough(bars, refused)) << refused;
}

TEST(ImagePart, MayHaveAnyLayers) {
  std::size_t bars = 0, unequal = 0;
  for_each_seed(1000, [&](Generator& random) {
    ImageCase c = random_image_case(random);
    if (is_refused(c)) return;
    const auto expected = pairs_of(ImagePart(c.image, 0, 1, c.options).barcode());
    for (int count = 1; count <= c.layers; ++count) {
      c.options.first_layers = random_first_layers(random, c.layers, count);
      const ImagePart whole = joined(random, parts_of(c.image, count, c.options));
      ASSERT_EQ(pairs_of(whole.barcode()), expected) << count << " parts";
      ASSERT_EQ(whole.options().first_layers, c.options.first_layers);
      for (int i = 0; i < count; ++i)
        unequal += c.options.first_layers[static_cast<std::size_t>(i)] != c.layers * i / count;
    }
    bars += expected.size();
  });
  EXPECT_TRUE(is_enough(bars, std::size_t{1500})) << bars;
  EXPECT_TRUE(is_enough(unequal, std::size_t{500})) << unequal;
}

TEST(ImagePart, RefusesLayersThatAreNone) {
  Generator random(6);
  const Image image = random.image({7, 4, 3}, false);
  for (const auto construction :
       {CubicalOptions::Construction::vertices, CubicalOptions::Construction::cells})
    for (const auto& layers : std::vector<std::vector<Index>>{{0, 3},
                                                              {0, 2, 4, 6},
                                                              {1, 3, 5},
                                                              {-1, 3, 5},
                                                              {0, 3, 3},
                                                              {0, 5, 3},
                                                              {0, 0, 3},
                                                              {0, -3, 3},
                                                              {0, 3, 7},
                                                              {0, 3, Index{1} << 40}}) {
      const ImagePartOptions options{
          .cubical = {.construction = construction}, .max_dim = 0, .first_layers = layers};
      for (int part = 0; part < 4; ++part) {
        const auto refused = [&](auto&& make) {
          try {
            make();
            ADD_FAILURE() << layers.size() << " layers, the second one " << layers[1];
          } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::usage);
            const std::string why = error.what();
            EXPECT_EQ(why.find("first layers of parts: found "), 0U) << why;
            EXPECT_NE(why.find("one for each of 3 parts, from 0 in ascending order, each below 7"),
                      std::string::npos)
                << why;
          }
        };
        refused([&] { ImagePart(image, part, 3, options); });
        refused([&] { ImagePart::forecast(image, 3, options); });
      }
    }
  for (const ImagePartOptions& options :
       {ImagePartOptions{.min_dim = -5}, ImagePartOptions{.max_dim = -1}}) {
    EXPECT_THROW(ImagePart(image, 0, 1, options), Error);
    EXPECT_THROW(ImagePart::forecast(image, 1, options), Error);
  }
  const ImagePart with_loops(image, 1, 3, {.loops = true});
  EXPECT_TRUE(with_loops.is_of(image, 1, 3, {.loops = true}));
  EXPECT_FALSE(with_loops.is_of(image, 1, 3, {}));
  EXPECT_FALSE(with_loops.is_of(image, 1, 3, {.max_dim = 0, .loops = true}));
  // The voxels of the part, and those of the layers next to it, decide. Others do not matter.
  const ImagePart begin(image, 0, 3, {.loops = true});
  using Case = std::tuple<std::size_t, bool, bool>;
  for (const auto& [layer, is_of_begin, is_of_middle] :
       {Case{0, false, true}, Case{1, false, false}, Case{2, false, false}, Case{3, true, false},
        Case{5, true, true}}) {
    Image other = image;
    const std::size_t voxel = layer * 12;
    other.values.change([&](auto& numbers) { numbers[voxel] += 1; });
    EXPECT_EQ(begin.is_of(other, 0, 3, {.loops = true}), is_of_begin) << layer;
    EXPECT_EQ(with_loops.is_of(other, 1, 3, {.loops = true}), is_of_middle) << layer;
  }
  // Parts with different first layers have different options, so they do not fit together.
  const ImagePartOptions equal{.max_dim = 0}, other{.max_dim = 0, .first_layers = {0, 1, 6}};
  ImagePart first(image, 0, 3, other);
  EXPECT_TRUE(first.is_of(image, 0, 3, other));
  EXPECT_FALSE(first.is_of(image, 0, 3, equal));
  EXPECT_THROW(first.join(ImagePart(image, 1, 3, equal)), Error);
  first.join(ImagePart(image, 1, 3, other));
  EXPECT_EQ(first.last(), 1);
}

// The bytes of the result do not depend on how parts are grouped. Images with holes are left out.
// If two holes have existed from the start, either of them may be closed first.
TEST(ImagePart, WhatIsKeptDoesNotDependOnGroups) {
  int compared = 0;
  for_each_seed(1000, [&](Generator& random) {
    const ImageCase c = random_image_case(random);
    const auto is_hole = [&](double v) {
      return std::isinf(v) ||
             (c.options.cubical.threshold &&
              (c.options.cubical.superlevel ? -v : v) > *c.options.cubical.threshold);
    };
    if (is_refused(c) || std::ranges::any_of(c.image.values, is_hole)) return;
    ++compared;
    // Joins the first three of four parts, once from the left and once from the right.
    if (c.layers < 4) return;
    auto left = parts_of(c.image, 4, c.options), right = parts_of(c.image, 4, c.options);
    left[0].join(std::move(left[1]));
    left[0].join(std::move(left[2]));
    right[1].join(std::move(right[2]));
    right[0].join(std::move(right[1]));
    ASSERT_TRUE(left[0].bytes() == right[0].bytes());
  });
  EXPECT_TRUE(is_enough(compared, 20)) << compared;
}

TEST(ImagePart, SlabsInsideDoNotMatter) {
  Generator random(5);
  const Image image = random.image({12, 7, 9}, false);
  const ImagePartOptions options{.cubical = {.periodic = {true, false, false}}, .max_dim = 0};
  const auto expected = joined(random, parts_of(image, 3, options)).barcode();
  for (int layers = 1; layers <= 5; ++layers) {
    RunContext context;
    context.slab_layers = layers;
    EXPECT_EQ(pairs_of(joined(random, parts_of(image, 3, options, context)).barcode()),
              pairs_of(expected));
  }
}

TEST(ImagePart, RefusesWhatDoesNotBelongTogether) {
  Generator random(1);
  const Image image = random.image({8, 6}, false), other = random.image({8, 6}, false);
  const auto refused = [](ImagePart& a, ImagePart b, const char* why) {
    expect_error(ErrorKind::bad_data, why, [&] { a.join(std::move(b)); });
  };
  ImagePart first(image, 0, 3);
  refused(first, ImagePart(image, 2, 3), "found part 3 after part 1");
  refused(first, ImagePart(image, 0, 3), "found part 1 after part 1");
  refused(first, ImagePart(image, 1, 4), "differ in extents, type, options or number of parts");
  refused(first, ImagePart(image, 1, 3, {.max_dim = 0}),
          "differ in extents, type, options or number of parts");
  ImagePart of_image(image, 0, 3);
  refused(of_image, ImagePart(other, 1, 3), "layers that do not match");
  EXPECT_EQ(of_image.bytes(), ImagePart(image, 0, 3).bytes());
  const ImagePartOptions cells{.cubical = {.construction = CubicalOptions::Construction::cells}};
  ImagePart turned(image, 0, 3, cells);
  const auto before = turned.bytes();
  refused(turned, ImagePart(other, 1, 3, cells), "layers that do not match");
  EXPECT_EQ(turned.bytes(), before);
}

TEST(ImagePart, RefusesPartsAndImagesThatAreNone) {
  Generator random(2);
  const Image image = random.image({4, 5}, false);
  const auto refused = [](const Image& of, int part, int parts, const char* why) {
    expect_error(ErrorKind::usage, why, [&] { ImagePart(of, part, parts); });
  };
  refused(image, 0, 5, "found 5, expected 1 to 4");
  refused(image, 0, 0, "found 0, expected 1 to 4");
  refused(image, 3, 3, "found part 4 of 3");
  refused(image, -1, 3, "found part 0 of 3");
  refused(random.image({7}, false), 0, 1, "expected at least two such axes");
  refused(random.image({2, 2, 2, 2, 2, 2, 2, 2, 2}, false), 0, 1, "found 9 axes");
  refused(random.image({3, 3, 3}, false), 0, 1, "dimension 0 alone, or 2 alone");
  refused(random.image({2, 2, 2, 2}, false), 0, 1, "from 1 to 2 need all layers at once");
}

TEST(ImagePart, RefusesDamagedBytes) {
  Generator random(3);
  const Image image = random.image({6, 7}, false);
  const std::vector<std::byte> bytes = ImagePart(image, 1, 3).bytes();
  std::size_t refused = 0;
  // Damaged bytes may be accepted as a part. Even then, joining this part must be safe: no index
  // may be out of range.
  const auto is_refused = [&](std::span<const std::byte> damaged) {
    return fails_with(ErrorKind::bad_data, [&] {
      ImagePart whole(image, 0, 3);
      whole.join(ImagePart::of_bytes(damaged));
      whole.join(ImagePart(image, 2, 3));
      const Barcode bars = whole.barcode();
      for (std::size_t i = 0; i < bars.size(); ++i)
        EXPECT_FALSE(std::isnan(bars[i].birth) || std::isnan(bars[i].death));
    });
  };
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_TRUE(is_refused(std::span(bytes).first(size))) << size;
  const auto content = content_of_part(bytes, "image");
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (const std::byte flipped : {std::byte{1}, std::byte{4}, std::byte{0x84}}) {
      auto damaged = bytes;
      damaged[i] ^= flipped;
      ASSERT_TRUE(is_refused(damaged)) << i;
    }
  // Damages the content and corrects the checksum. A changed value may be accepted, but a changed
  // list must be refused.
  for (std::size_t i = 0; i < content.size(); ++i)
    for (const std::byte flipped : {std::byte{1}, std::byte{4}, std::byte{0x84}}) {
      std::vector<std::byte> damaged(content.begin(), content.end());
      damaged[i] ^= flipped;
      refused += is_refused(sealed_part("image", damaged)) ? 1 : 0;
    }
  EXPECT_GT(refused, content.size() / 4);
  // Writes NaN to each place that may hold a value.
  for (std::size_t i = 0; i + sizeof(double) <= content.size(); ++i) {
    std::vector<std::byte> damaged(content.begin(), content.end());
    std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(i), sizeof(double), std::byte{0xff});
    is_refused(sealed_part("image", damaged));
  }
  EXPECT_TRUE(is_refused(sealed_part("inputs", content)));
}

TEST(ImagePart, RefusesDamagedLayers) {
  Generator random(3);
  const Image image = random.image({300, 2}, false);
  const ImagePartOptions options{.first_layers = {0, 258, 299}};
  const std::vector<std::byte> bytes = ImagePart(image, 1, 3, options).bytes();
  const auto content = content_of_part(bytes, "image");
  ByteWriter layers;
  layers.put_list(options.first_layers, [&](Index layer) { layers.put(std::int64_t{layer}); });
  const auto found = std::ranges::search(content, layers.bytes());
  ASSERT_EQ(found.size(), layers.bytes().size());
  const auto begin = static_cast<std::size_t>(found.begin() - content.begin());
  const auto is_refused = [&](std::span<const std::byte> damaged) {
    return fails_with(ErrorKind::bad_data, [&] {
      ImagePart first(image, 0, 3, options);
      first.join(ImagePart::of_bytes(sealed_part("image", damaged)));
    });
  };
  EXPECT_FALSE(is_refused(content));
  for (std::size_t i = begin; i < begin + found.size(); ++i)
    for (unsigned flipped = 1; flipped < 256; ++flipped) {
      std::vector<std::byte> damaged(content.begin(), content.end());
      damaged[i] ^= static_cast<std::byte>(flipped);
      ASSERT_TRUE(is_refused(damaged)) << i - begin << " ^ " << flipped;
    }
}

// Cook's catalogue of CRCs gives this check value for the digits 1 to 9.
TEST(Crc32, HasTheKnownValue) {
  std::vector<std::byte> digits;
  for (const char digit : std::string_view("123456789"))
    digits.push_back(static_cast<std::byte>(digit));
  EXPECT_EQ(crc32(digits), 0xCBF43926U);
  EXPECT_EQ(crc32({}), 0U);
}

}  // namespace
}  // namespace ph::test
