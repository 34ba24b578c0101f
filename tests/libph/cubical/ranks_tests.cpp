// SPDX-License-Identifier: MIT
// Images and clouds on several ranks: compares the results with one process. The ranks are threads
// that exchange messages. In some tests, messages are lost, duplicated, reordered or changed.
#include <gtest/gtest.h>

#include <random>

#include "ph/detail/facade/bar_bytes.hpp"
#include "ph/detail/facade/join_ranks.hpp"
#include "ph/parts/cloud_part.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/image_cases.hpp"
#include "tests/support/thread_ranks.hpp"

namespace ph::test {
namespace {

/// The barcode that rank 0 computes.
Barcode bars_of_ranks(const ImageCase& c, ThreadRanks& ranks, std::int64_t field = 2) {
  Barcode bars(CellKind::grid);
  ranks.run([&](Transport& transport) {
    Post post(transport);
    const RunContext& context = default_context();
    const int rank = post.rank(), parts = std::min(post.size(), c.layers);
    std::optional<ImagePart> own;
    std::optional<ImageLoops> loops;
    if (rank < parts) own.emplace(c.image, rank, parts, c.options);
    const bool has_loops = own && own->has_loops();
    if (has_loops) loops.emplace(*own, field, context);
    const std::optional<ImagePart> whole = join_ranks(std::move(own), post, context);
    EXPECT_EQ(whole.has_value(), rank == 0);
    Barcode found(CellKind::grid);
    if (has_loops)
      found = loops_of_ranks(std::move(loops), parts, whole ? &*whole : nullptr, post, context);
    if (!whole) return;
    bars = whole->barcode();
    add_bars(bars, found);
    bars.sort(context);
  });
  return bars;
}

TEST(Ranks, AgreeWithTheOracle) {
  std::mt19937 delays(7);
  std::size_t bars = 0, loops = 0, of_many_axes = 0;
  for_each_seed(1500, [&](Generator& random) {
    const bool has_many_axes = random.integer(0, 7) == 0;
    ImageCase c = has_many_axes ? random_case_of_many_axes(random) : random_image_case(random);
    if (c.image.values.size() > 200) return;  // the oracle would be slow
    c.options.loops = true;
    if (random.coin()) {
      c.options.min_dim = 0;
      c.options.max_dim = std::nullopt;
    }
    if (is_refused(c)) return;  // images with more than three axes may be refused
    const std::int64_t field = random.coin() ? 2 : 3;
    ASSERT_EQ(ImagePart::most_parts(c.image, c.options.cubical), c.layers);
    const Options oracle{.max_dim = c.options.max_dim.value_or(c.image.dim()),
                         .min_dim = c.options.min_dim,
                         .field = field,
                         .engine = Engine::standard};
    const auto expected = pairs_of(persistence(Cubical(c.image, c.options.cubical), oracle));
    const int count = random.integer(1, 9);
    if (random.coin())
      c.options.first_layers = random_first_layers(random, c.layers, std::min(count, c.layers));
    ThreadRanks ranks(count, random.coin() ? &delays : nullptr);
    ASSERT_EQ(pairs_of(bars_of_ranks(c, ranks, field)), expected);
    bars += expected.size();
    of_many_axes += has_many_axes ? 1 : 0;
    loops += c.image.dim() == 3 && !c.options.max_dim ? 1 : 0;
  });
  EXPECT_TRUE(is_enough(bars, std::size_t{2000})) << bars;
  EXPECT_TRUE(is_enough(loops, std::size_t{200})) << loops;
  EXPECT_TRUE(is_enough(of_many_axes, std::size_t{30})) << of_many_axes;
}

TEST(Ranks, JoinClouds) {
  std::mt19937 delays(8);
  for_each_seed(200, [&](Generator& random) {
    const Points points = random.points(random.integer(0, 60), random.integer(1, 4), random.coin());
    ThreadRanks ranks(random.integer(1, 9), &delays);
    Barcode bars;
    ranks.run([&](Transport& transport) {
      Post post(transport);
      CloudPart own(points, post.rank(), post.size());
      const auto whole = join_ranks(std::optional(std::move(own)), post, default_context());
      EXPECT_EQ(whole.has_value(), post.rank() == 0);
      if (whole) bars = whole->barcode();
    });
    EXPECT_TRUE(std::ranges::equal(bars, persistence(Rips(points), {.max_dim = 0})));
  });
}

class Mishaps : public testing::TestWithParam<Mishap> {};

TEST_P(Mishaps, AreSeen) {
  int happened = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Generator random(seed);
    const ImageCase c{random.image({9, 5}, false), {}, 9};
    ThreadRanks ranks(9, nullptr);
    ranks.plan(GetParam(), static_cast<int>(seed) % 8);
    fails_with(ErrorKind::io, [&] {
      const Barcode bars = bars_of_ranks(c, ranks);
      // If a message arrives twice, only the first copy is read.
      EXPECT_TRUE(GetParam() == Mishap::doubled || !ranks.has_happened());
      EXPECT_EQ(pairs_of(bars), pairs_of(ImagePart(c.image, 0, 1).barcode()));
    });
    happened += ranks.has_happened() ? 1 : 0;
  }
  EXPECT_EQ(happened, 12);
}
INSTANTIATE_TEST_SUITE_P(All, Mishaps,
                         testing::Values(Mishap::lost, Mishap::doubled, Mishap::swapped,
                                         Mishap::changed));

/// Sends three messages from rank 1 to rank 0, which reads three messages.
void three_messages(ThreadRanks& ranks) {
  ranks.run([](Transport& transport) {
    Post post(transport);
    for (int i = 0; i < 3; ++i) {
      const std::vector<std::byte> message(static_cast<std::size_t>(i), std::byte{7});
      if (post.rank() == 1) post.send(0, message);
      if (post.rank() == 0) {
        EXPECT_EQ(post.receive(1), message);
      }
    }
    if (post.rank() == 1) {
      EXPECT_EQ(post.bytes_sent(), 3U * 12 + 3);
    }
  });
}

TEST(Post, KnowsItsMessages) {
  ThreadRanks calm(2, nullptr);
  three_messages(calm);
  for (const Mishap mishap : {Mishap::lost, Mishap::doubled, Mishap::swapped, Mishap::changed})
    for (int message = 0; message < 2; ++message) {
      ThreadRanks ranks(2, nullptr);
      ranks.plan(mishap, message);
      expect_error(ErrorKind::io, "rank 0: message from rank 1: found",
                   [&] { three_messages(ranks); });
    }
}

}  // namespace
}  // namespace ph::test
