// SPDX-License-Identifier: MIT
// Forecasts for images in parts. Checks the first layers that a forecast proposes for any image,
// and compares the predicted numbers of bytes with the actual numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <optional>

#include "ph/detail/facade/join_ranks.hpp"
#include "ph/parts/image_loops.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/image_cases.hpp"
#include "tests/support/thread_ranks.hpp"

namespace ph::test {
namespace {

using Construction = CubicalOptions::Construction;

void expect_in_order(const ImagePartForecast::Bytes& bytes) {
  EXPECT_GE(bytes.low, 0);
  EXPECT_LE(bytes.low, bytes.high);
  EXPECT_TRUE(std::isfinite(bytes.high));
}

/// Makes a forecast for each number of parts, and checks that parts accept the predicted first
/// layers.
void expect_valid(const Image& image, ImagePartOptions options, int layers) {
  for (int parts = 1; parts <= layers; ++parts) {
    SCOPED_TRACE(parts);
    options.first_layers = {};
    const ImagePartForecast forecast = ImagePart::forecast(image, parts, options);
    const std::vector<Index>& first = forecast.first_layers;
    ASSERT_EQ(first.size(), static_cast<std::size_t>(parts));
    ASSERT_EQ(first.front(), 0);
    ASSERT_LT(first.back(), layers);
    for (std::size_t i = 1; i < first.size(); ++i) ASSERT_LT(first[i - 1], first[i]);
    EXPECT_GE(forecast.longest, 1);
    EXPECT_LE(forecast.longest, parts * (1 + 1e-12));
    for (const auto& bytes : {forecast.memory, forecast.file, forecast.join, forecast.sent})
      expect_in_order(bytes);
    options.first_layers = first;
    EXPECT_LE(ImagePart::forecast(image, parts, options).longest, parts * (1 + 1e-12));
  }
}

TEST(PartForecast, LayersAreAlwaysValid) {
  for_each_seed(1000, [&](Generator& random) {
    ImageCase c = random_image_case(random);
    c.options.loops = true;
    if (is_refused(c)) return;  // images with more than three axes may be refused
    ASSERT_NO_FATAL_FAILURE(expect_valid(c.image, c.options, c.layers));
  });
}

Image volume_of(std::vector<Index> extents, auto&& value) {
  Index count = 1;
  for (const Index n : extents) count *= n;
  std::vector<std::remove_cvref_t<decltype(value(0))>> voxels;
  for (Index i = 0; i < count; ++i) voxels.push_back(value(i));
  return {std::move(extents), std::move(voxels)};
}

TEST(PartForecast, LayersAreValidOfImagesOfOneKind) {
  constexpr double never = std::numeric_limits<double>::quiet_NaN();
  Generator random(1);
  for (const auto construction : {Construction::vertices, Construction::cells})
    for (const bool loops : {false, true}) {
      const ImagePartOptions options{.cubical = {.construction = construction},
                                     .max_dim = loops ? std::nullopt : std::optional(0),
                                     .loops = loops};
      for (const std::vector<Index>& extents :
           {std::vector<Index>{9, 5}, {7, 4, 3}, {70, 2, 2}, {200, 3}, {2, 2, 2}}) {
        const auto valid = [&](auto&& value) {
          Image image = volume_of(extents, value);
          image.masked = true;
          expect_valid(image, options, static_cast<int>(extents[0]));
        };
        ASSERT_NO_FATAL_FAILURE(valid([](Index) { return 3.0; }));
        ASSERT_NO_FATAL_FAILURE(valid([](Index) { return never; }));
        ASSERT_NO_FATAL_FAILURE(valid([](Index i) { return i == 0 ? 1.0 : never; }));
        ASSERT_NO_FATAL_FAILURE(valid([](Index) { return -kInfinity; }));
        ASSERT_NO_FATAL_FAILURE(valid([](Index i) { return static_cast<float>(i); }));
        ASSERT_NO_FATAL_FAILURE(valid([](Index i) { return static_cast<float>(-i); }));
        ASSERT_NO_FATAL_FAILURE(
            valid([&](Index) { return static_cast<std::uint8_t>(random.integer(0, 255)); }));
        ASSERT_NO_FATAL_FAILURE(
            valid([&](Index i) { return static_cast<std::uint8_t>(i < 9 ? i * 251 : 255); }));
      }
    }
}

TEST(PartForecast, LayersWithMuchInThemAreShared) {
  Generator random(2);
  for (const bool is_turned : {false, true}) {
    const Image image = volume_of({64, 24, 24}, [&](Index i) {
      const Index layer = is_turned ? 63 - i / 576 : i / 576;
      return layer < 16 ? random.real() : static_cast<double>(i);
    });
    for (const auto construction : {Construction::vertices, Construction::cells}) {
      ImagePartOptions options{.cubical = {.construction = construction}, .loops = true};
      const ImagePartForecast forecast = ImagePart::forecast(image, 4, options);
      EXPECT_GT(forecast.longest, 2.5);
      const std::vector<Index>& first = forecast.first_layers;
      for (std::size_t i = 1; i < 4; ++i) {
        EXPECT_GT(first[i], is_turned ? 47 : 2);
        EXPECT_LT(first[i], is_turned ? 62 : 17);
      }
      options.first_layers = first;
      EXPECT_LT(ImagePart::forecast(image, 4, options).longest, 1.4);
    }
  }
}

// Layers with few rows and layers with long rows. The forecast examines only some voxels of them.
TEST(PartForecast, LongRowsAreSeen) {
  Generator random(3);
  for (const std::vector<Index>& extents :
       {std::vector<Index>{16, 40'000}, {16, 1, 40'000}, {16, 2, 20'000}, {16, 3, 20'000}}) {
    Index count = 1;
    for (const Index n : extents) count *= n;
    const Image image =
        volume_of(extents, [&](Index i) { return i < count / 4 ? random.real() : 2.0; });
    const ImagePartForecast forecast = ImagePart::forecast(image, 4, {.max_dim = 0});
    EXPECT_GT(forecast.longest, 1.5);
    EXPECT_LT(forecast.first_layers[1], 4);
  }
}

/// The memory and the bytes that the parts needed.
struct Taken {
  /// The memory and the file size of the largest part, and the bytes of all messages.
  double memory = 0, file = 0, sent = 0;
};

/// Runs each part on a rank and measures what it needs. The image does not count towards the memory
/// budget of any rank.
Taken taken_on_ranks(const Image& image, const ImagePartOptions& options, int parts) {
  Taken taken;
  std::mutex mutex;
  ThreadRanks ranks(parts, nullptr);
  ranks.run([&](Transport& transport) {
    Post post(transport);
    RunContext context;
    context.threads = 1;
    std::optional<ImagePart> own(std::in_place, image, post.rank(), parts, options, context);
    const auto file = static_cast<double>(own->bytes().size());
    std::optional<ImageLoops> loops;
    const bool has_loops = own->has_loops();
    if (has_loops) loops.emplace(*own, 2, context);
    const auto memory = static_cast<double>(context.memory.peak());
    const std::optional<ImagePart> whole = join_ranks(std::move(own), post, context);
    if (has_loops)
      loops_of_ranks(std::move(loops), parts, whole ? &*whole : nullptr, post, context);
    const std::lock_guard lock(mutex);
    taken.memory = std::max(taken.memory, memory);
    taken.file = std::max(taken.file, file);
    taken.sent += static_cast<double>(post.bytes_sent());
  });
  return taken;
}

TEST(PartForecast, NoiseTakesWhatIsForeseen) {
  Generator random(4);
  const Image image = volume_of({64, 64, 64}, [&](Index) { return random.real(); });
  for (const auto construction : {Construction::vertices, Construction::cells})
    for (const int dims : {0, 2, 3})  // only components; only voids; all dimensions
      for (const int parts : {2, 3}) {
        ImagePartOptions options{.cubical = {.construction = construction}, .cells = dims == 3};
        if (dims == 0) options.max_dim = 0;
        if (dims == 2) options.min_dim = 2;
        options.loops = dims == 3;
        SCOPED_TRACE(testing::Message() << parts << " parts, dimensions " << dims << ", "
                                        << static_cast<int>(construction));
        const ImagePartForecast forecast = ImagePart::forecast(image, parts, options);
        const Taken taken = taken_on_ranks(image, options, parts);
        EXPECT_GE(taken.file, forecast.file.low);
        EXPECT_LE(taken.file, forecast.file.high);
        // The forecast includes the voxels of a mapped file. The measurement does not include the
        // voxels of the image.
        EXPECT_GE(taken.memory + 8.0 * 64 * 64 * (64 / parts + 1), forecast.memory.low);
        EXPECT_LE(taken.memory, forecast.memory.high);
        EXPECT_GE(taken.sent, forecast.sent.low);
        EXPECT_LE(taken.sent, forecast.sent.high);
      }
}

}  // namespace
}  // namespace ph::test
