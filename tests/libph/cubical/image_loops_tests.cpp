// SPDX-License-Identifier: MIT
// Loops of volumes that are computed in parts, in any order of work and of messages: compares them
// with the loops of the whole volumes. Covers any number of parts, both constructions, holes,
// infinities, ties and periodic axes.
#include "ph/parts/image_loops.hpp"

#include <gtest/gtest.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <iostream>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/generators.hpp"

namespace ph::test {
namespace {

using Construction = CubicalOptions::Construction;

struct Case {
  Image image;
  ImagePartOptions options;
  int layers;
  std::int64_t field;
};
Case random_case(Generator& random) {
  Case result{{}, {.loops = true}, 0, random.coin() ? 2 : random.coin() ? 3 : 5};
  const bool is_long = random.integer(0, 3) == 0;
  std::vector<Index> extents{random.integer(2, is_long ? 9 : 5), random.integer(2, is_long ? 3 : 4),
                             random.integer(2, is_long ? 3 : 4)};
  result.layers = static_cast<int>(extents[0]);
  if (random.integer(0, 7) == 0) extents.insert(extents.begin() + random.integer(0, 3), 1);
  CubicalOptions& cubical = result.options.cubical;
  cubical = random.cubical_options(static_cast<int>(extents.size()));
  if (random.integer(0, 2) == 0) cubical.periodic.assign(extents.size(), true);
  for (std::size_t k = 0; k < extents.size(); ++k)  // makes an axis of one voxel periodic
    if (extents[k] == 1 && cubical.construction == Construction::cells) cubical.periodic[k] = true;
  result.image = random.image(extents, random.coin());
  if (random.integer(0, 3) == 0) cubical.threshold = random.integer(-2, 3);
  if (random.integer(0, 3) == 0) {
    result.image.masked = true;
    const double never = std::numeric_limits<double>::quiet_NaN();
    for (int i = random.integer(1, 6); i-- > 0;) {
      const auto hole = static_cast<std::size_t>(
          random.integer(0, static_cast<int>(result.image.values.size()) - 1));
      result.image.values.change([&](auto& all) {
        using T = typename std::remove_cvref_t<decltype(all)>::value_type;
        all[hole] = static_cast<T>(never);
      });
    }
  }
  return result;
}

/// The order in which parts work and messages arrive.
enum class Schedule { rounds, random, one_at_a_time, last_message_first };

struct Outcome {
  std::vector<Pair> pairs;
  ImageLoops::Traffic traffic;
};

Outcome run_in_parts(Generator& random, const Case& c, int count, Schedule schedule) {
  std::vector<ImageLoops> loops;
  std::optional<ImagePart> whole;
  for (int i = 0; i < count; ++i) {
    ImagePart part(c.image, i, count, c.options);
    loops.emplace_back(part, c.field);
    // Some parts are written to bytes and read back, as if they were sent between machines.
    if (random.coin()) part = ImagePart::of_bytes(part.bytes());
    if (whole)
      whole->join(std::move(part));
    else
      whole.emplace(std::move(part));
  }
  std::vector<ImageLoops::Message> on_their_way;
  std::vector<bool> has_begun(loops.size(), false);
  const auto post = [&](ImageLoops& from) {
    for (auto& message : from.take_messages()) {
      EXPECT_NE(message.to, from.part());
      on_their_way.push_back(std::move(message));
    }
  };
  const auto begin = [&](std::size_t i) {
    loops[i].begin(whole->told_to_loops(static_cast<int>(i)));
    has_begun[i] = true;
    post(loops[i]);
  };
  const auto pick = [&](std::size_t size) {
    return static_cast<std::size_t>(random.integer(0, static_cast<int>(size) - 1));
  };
  const auto deliver = [&](std::size_t i) {
    auto message = std::move(on_their_way[i]);
    on_their_way.erase(on_their_way.begin() + static_cast<std::ptrdiff_t>(i));
    loops[static_cast<std::size_t>(message.to)].receive(message.bytes);
  };
  if (schedule == Schedule::rounds)
    for (std::size_t i = 0; i < loops.size(); ++i) begin(i);
  const auto is_done = [&] {
    return on_their_way.empty() && std::ranges::all_of(loops, &ImageLoops::is_idle) &&
           std::ranges::find(has_begun, false) == has_begun.end();
  };
  while (!is_done()) {
    if (schedule == Schedule::rounds) {
      for (ImageLoops& part : loops) part.work();
      for (ImageLoops& part : loops) post(part);
      while (!on_their_way.empty()) deliver(0);
      continue;
    }
    const std::size_t i = pick(loops.size());
    if (!has_begun[i]) {
      if (random.integer(0, 3) == 0) begin(i);
    } else if (random.coin()) {
      loops[i].work(schedule == Schedule::one_at_a_time
                        ? 1
                        : static_cast<std::size_t>(random.integer(1, 20)));
      post(loops[i]);
    }
    if (on_their_way.empty()) continue;
    // The last message is delivered first, and only when no part can work without it.
    if (schedule == Schedule::last_message_first) {
      if (std::ranges::all_of(loops, &ImageLoops::is_idle)) deliver(on_their_way.size() - 1);
    } else if (random.coin()) {
      deliver(pick(on_their_way.size()));
    }
  }
  Outcome run{pairs_of(whole->barcode()), {}};
  for (const ImageLoops& part : loops) {
    const auto more = pairs_of(part.barcode());
    run.pairs.insert(run.pairs.end(), more.begin(), more.end());
    const auto traffic = part.traffic();
    run.traffic.columns_sent += traffic.columns_sent;
    run.traffic.columns_received += traffic.columns_received;
    run.traffic.messages_sent += traffic.messages_sent;
    run.traffic.messages_received += traffic.messages_received;
  }
  std::sort(run.pairs.begin(), run.pairs.end());
  return run;
}

/// Makes malloc keep the memory that parts free, because otherwise these tests would spend most of
/// their time on system calls.
void keep_memory() {
#ifdef __GLIBC__
  constexpr int much = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, much);
  mallopt(M_TRIM_THRESHOLD, much);
#endif
}

TEST(ImageLoops, AgreeWithTheOracleCellByCell) {
  keep_memory();
  std::size_t runs = 0, loops = 0, sent = 0;
  for_each_seed(3300, [&](Generator& random) {
    const Case c = random_case(random);
    const auto expected = pairs_of(
        persistence(Cubical(c.image, c.options.cubical),
                    {.max_dim = c.image.dim(), .field = c.field, .engine = Engine::standard}));
    for (const Pair& pair : expected) loops += pair.bar.dim == 1 ? 1 : 0;
    for (int count = 1; count <= c.layers; ++count)
      for (const Schedule schedule : {Schedule::rounds, Schedule::random, Schedule::one_at_a_time,
                                      Schedule::last_message_first}) {
        const Outcome run = run_in_parts(random, c, count, schedule);
        ASSERT_EQ(run.pairs, expected)
            << count << " parts, schedule " << static_cast<int>(schedule);
        ASSERT_EQ(run.traffic.columns_sent, run.traffic.columns_received);
        ASSERT_EQ(run.traffic.messages_sent, run.traffic.messages_received);
        sent += run.traffic.columns_sent;
        ++runs;
      }
  });
  EXPECT_TRUE(is_enough(runs, std::size_t{50000})) << runs;
  EXPECT_TRUE(is_enough(loops, std::size_t{3000})) << loops;
  EXPECT_TRUE(is_enough(sent, std::size_t{10000})) << sent;
  // These numbers help in longer searches that are started by hand.
  std::cout << runs << " runs, " << loops << " loops, " << sent << " columns sent\n";
}

/// The loops of all parts of an image after each part has begun, and the first messages of the
/// parts.
struct Begun {
  std::vector<ImageLoops> loops;
  std::vector<ImageLoops::Message> messages;
};
Begun begun(const Image& image, int count, const ImagePartOptions& options, std::int64_t field = 2,
            const RunContext& context = default_context()) {
  Begun all;
  std::optional<ImagePart> whole;
  for (int i = 0; i < count; ++i) {
    ImagePart part(image, i, count, options, context);
    all.loops.emplace_back(part, field, context);
    if (whole)
      whole->join(std::move(part));
    else
      whole.emplace(std::move(part));
  }
  for (ImageLoops& part : all.loops) {
    part.begin(whole->told_to_loops(part.part()));
    for (auto& message : part.take_messages()) all.messages.push_back(std::move(message));
  }
  return all;
}

/// Exchanges messages until none is in transit. @return the bars of all parts.
std::vector<Pair> finished(Begun all) {
  while (!all.messages.empty()) {
    for (const auto& message : std::exchange(all.messages, {}))
      all.loops[static_cast<std::size_t>(message.to)].receive(message.bytes);
    for (ImageLoops& part : all.loops) {
      part.work();
      for (auto& message : part.take_messages()) all.messages.push_back(std::move(message));
    }
  }
  std::vector<Pair> pairs;
  for (const ImageLoops& part : all.loops) {
    const auto more = pairs_of(part.barcode());
    pairs.insert(pairs.end(), more.begin(), more.end());
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// There are enough columns for several threads, and for rounds in which threads take each other's
// pivots.
TEST(ImageLoops, ThreadsDoNotMatter) {
  for (const Construction construction : {Construction::vertices, Construction::cells}) {
    Generator random(7);
    const Image image = random.image({24, 25, 26}, false);
    const ImagePartOptions options{
        .cubical = {.construction = construction, .periodic = {true, false, false}},
        .min_dim = 1,
        .max_dim = 1,
        .loops = true};
    RunContext context;
    context.threads = 4;
    const auto pairs = finished(begun(image, 3, options, 3, context));
    EXPECT_EQ(pairs, pairs_of(persistence(
                         Cubical(image, options.cubical),
                         {.max_dim = 1, .min_dim = 1, .field = 3, .engine = Engine::gradient})));
    EXPECT_GT(pairs.size(), 1000U);
  }
}

TEST(ImageLoops, RefuseDamagedMessages) {
  Generator random(3);
  const Image image = random.image({8, 9, 9}, false);
  Begun all = begun(image, 2, {.loops = true});
  for (const auto& message : std::exchange(all.messages, {}))
    all.loops[static_cast<std::size_t>(message.to)].receive(message.bytes);
  all.loops[0].work();
  const auto messages = all.loops[0].take_messages();
  ASSERT_EQ(messages.size(), 1U);
  ASSERT_EQ(messages[0].to, 1);
  const std::vector<std::byte>& bytes = messages[0].bytes;
  const auto is_refused = [](ImageLoops& part, std::span<const std::byte> message) {
    return fails_with(ErrorKind::bad_data, [&] { part.receive(message); });
  };
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_TRUE(is_refused(all.loops[1], std::span(bytes).first(size))) << size;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (const std::byte flipped : {std::byte{1}, std::byte{0x84}}) {
      auto damaged = bytes;
      damaged[i] ^= flipped;
      ASSERT_TRUE(is_refused(all.loops[1], damaged)) << i;
    }
  EXPECT_TRUE(is_refused(all.loops[0], bytes)) << "a message for another part";
  EXPECT_TRUE(is_refused(begun(image, 2, {.loops = true}, 3).loops[1], bytes)) << "another field";
  EXPECT_TRUE(is_refused(begun(image, 3, {.loops = true}).loops[1], bytes)) << "other parts";
  EXPECT_FALSE(is_refused(all.loops[1], bytes));
  EXPECT_TRUE(is_refused(all.loops[1], bytes)) << "a message that was received before";
}

TEST(ImageLoops, RefuseWhatTheyCannotBeginWith) {
  Generator random(4);
  const Image image = random.image({4, 4, 4}, false);
  const auto kind_of = [](auto&& run) -> std::optional<ErrorKind> {
    try {
      run();
      return std::nullopt;
    } catch (const Error& error) {
      return error.kind();
    }
  };
  ImagePart first(image, 0, 2, {.loops = true}), second(image, 1, 2, {.loops = true});
  EXPECT_TRUE(first.has_loops());
  EXPECT_EQ(kind_of([&] { ImageLoops(first, 4); }), ErrorKind::usage) << "no field";
  ImageLoops loops(first);
  EXPECT_EQ(kind_of([&] { ImageLoops again(first); }), ErrorKind::usage) << "used";
  ImagePart of_bytes = ImagePart::of_bytes(second.bytes());
  EXPECT_EQ(kind_of([&] { ImageLoops none(of_bytes); }), ErrorKind::usage) << "only bytes";
  ImagePart without(image, 0, 2, {.max_dim = 0, .loops = true});
  EXPECT_FALSE(without.has_loops());
  EXPECT_EQ(kind_of([&] { ImageLoops none(without); }), ErrorKind::usage) << "not wanted";
  first.join(std::move(second));
  EXPECT_EQ(kind_of([&] { loops.begin(first.told_to_loops(1)); }), ErrorKind::bad_data);
  const auto told = first.told_to_loops(0);
  EXPECT_EQ(kind_of([&] { loops.begin(std::span(told).first(told.size() - 1)); }),
            ErrorKind::bad_data);
}

}  // namespace
}  // namespace ph::test
