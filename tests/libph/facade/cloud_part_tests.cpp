// SPDX-License-Identifier: MIT
// Clouds in parts that are computed independently and joined in random groups and orders. Compares
// the components with Prim's algorithm on all pairs of points (implemented here), and with the
// components of the whole cloud. Covers any number of parts, blocks and sample points, ties,
// copies, lattices, lines, clusters far apart, and thresholds.
#include "ph/parts/cloud_part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "ph/detail/core/sealed_part.hpp"
#include "ph/merge_tree.hpp"
#include "tests/support/conformance.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/for_each_seed.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/points.hpp"
#include "tests/support/run_contexts.hpp"

namespace ph::test {
namespace {

/// Joins parts in random order until one is left. Occasionally, a part is written to bytes and read
/// back.
CloudPart joined(Generator& random, std::vector<CloudPart> parts) {
  const auto any = [&] {
    return static_cast<std::size_t>(random.integer(0, static_cast<int>(parts.size()) - 1));
  };
  for (;;) {
    const std::size_t i = any();
    if (random.integer(0, 2) == 0) {
      const auto bytes = parts[i].bytes();
      parts[i] = CloudPart::of_bytes(bytes);
      EXPECT_EQ(parts[i].bytes(), bytes);
    }
    if (parts.size() == 1) return std::move(parts[0]);
    const std::size_t j = any();
    if (i == j) continue;
    parts[i].join(std::move(parts[j]));
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
  }
}

std::vector<CloudPart> parts_of(PointsView points, int count, const CloudPartOptions& options,
                                const RunContext& context = default_context()) {
  std::vector<CloudPart> parts;
  for (int i = 0; i < count; ++i) parts.emplace_back(points, i, count, options, context);
  return parts;
}

/// The deaths of the components, computed from all pairs of points without libph.
std::vector<double> deaths_by_all_pairs(const Points& points, double limit) {
  const auto n = static_cast<std::size_t>(points.rows());
  std::vector<double> nearest(n, std::numeric_limits<double>::infinity()), deaths;
  std::vector<bool> is_in(n);
  for (std::size_t step = 0; step < n; ++step) {
    std::size_t next = n;
    for (std::size_t i = 0; i < n; ++i)
      if (!is_in[i] && (next == n || nearest[i] < nearest[next])) next = i;
    is_in[next] = true;
    const double d = nearest[next];
    deaths.push_back(d <= limit ? d : std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0;
      for (Index k = 0; k < points.cols(); ++k) {
        const double gap = points(static_cast<Index>(i), k) - points(static_cast<Index>(next), k);
        sum += gap * gap;
      }
      nearest[i] = std::min(nearest[i], std::sqrt(sum));
    }
  }
  std::erase(deaths, 0.0);
  std::ranges::sort(deaths);
  return deaths;
}

std::vector<double> deaths_of(const Barcode& bars) {
  std::vector<double> deaths;
  for (const Bar& bar : bars) deaths.push_back(bar.death);
  std::ranges::sort(deaths);
  return deaths;
}

std::vector<Pair> all_pairs(const Rips& rips) {
  return pairs_of(persistence(rips, {.max_dim = 0, .min_persistence = -1}));
}

Points random_cloud(Generator& random, Index most, bool ties) {
  Points points =
      random.points(random.integer(1, static_cast<int>(most)), random.integer(1, 4), ties);
  const Index n = points.rows(), d = points.cols();
  switch (random.integer(0, 6)) {
    case 0:  // a lattice, sometimes with gaps
      for (double& x : points.coordinates()) x = std::round(5 * x);
      break;
    case 1:  // clusters far apart, some of them clusters of clusters
      for (Index i = 0; i < n; ++i) {
        const double size = std::ldexp(1, -random.integer(0, 30));
        const Index of = random.integer(0, 3) % n;
        for (Index k = 0; k < d; ++k) points(i, k) = points(i, k) * size + 100.0 * points(of, k);
      }
      break;
    case 2:  // points on a line
      for (Index i = 0; i < n; ++i)
        for (Index k = 1; k < d; ++k) points(i, k) = points(i, 0);
      break;
    case 3:  // copies of a few points
      for (Index i = 1; i < n; ++i)
        if (random.coin())
          copy_point(points, random.integer(0, static_cast<int>(i) - 1), points, i);
      break;
    case 4:  // a dense group, and few points elsewhere
      for (Index i = 0; i < n; ++i)
        if (random.integer(0, 9) > 0) scale(points.row(i), 1e-3);
      break;
    default:
      break;
  }
  return points;
}

CloudPartOptions random_options(Generator& random, Index points, bool ties) {
  CloudPartOptions options{.blocks = random.integer(0, 3)};
  if (random.integer(0, 2) > 0)
    options.sample = random.integer(1, static_cast<int>(std::max<Index>(points, 1)));
  if (random.integer(0, 3) == 0) options.threshold = random.value(ties) * random.integer(0, 2);
  return options;
}

TEST(CloudPart, HasTheComponentsOfAllPairs) {
  std::size_t parts = 0;
  for_each_seed(6000, [&](Generator& random, bool ties, std::int64_t) {
    const Points points = random_cloud(random, 60, ties);
    const CloudPartOptions options = random_options(random, points.rows(), ties);
    const RipsOptions as_one{.threshold = options.threshold};
    const auto expected = deaths_by_all_pairs(points, options.threshold.value_or(kInfinity));
    const Rips all(points, as_one);
    const Barcode bars =
        with_all_edges(all, 0, [](const auto& f) { return persistence(f, {.max_dim = 0}); });
    const auto pairs = all_pairs(all);
    const MergeTree tree = merge_tree(all);
    ASSERT_EQ(deaths_of(bars), expected);
    const int count = random.integer(1, 9);
    parts += static_cast<std::size_t>(count);
    const CloudPart whole = joined(random, parts_of(points, count, options));
    ASSERT_TRUE(whole.is_whole());
    const Rips rips = whole.rips();
    const Barcode found = persistence(rips, {.max_dim = 0});
    ASSERT_EQ(deaths_of(found), expected);
    const Barcode without_cells = whole.barcode();
    ASSERT_TRUE(std::ranges::equal(without_cells, found));
    ASSERT_EQ(pairs_of(found), pairs_of(bars));
    ASSERT_EQ(all_pairs(rips), pairs);  // the pairs include pairs of length 0
    const MergeTree found_tree = merge_tree(rips);
    ASSERT_EQ(found_tree.births, tree.births);
    ASSERT_EQ(found_tree.merges, tree.merges);
  });
  EXPECT_TRUE(is_enough(parts, std::size_t{20000})) << parts;
}

// Most points of such a cloud are far from any one block, and a part leaves them out.
TEST(CloudPart, OfManyPoints) {
  for_each_seed(40, [&](Generator& random, bool ties, std::int64_t) {
    Points points = random_cloud(random, 20000, false);
    if (ties)
      for (double& x : points.coordinates()) x = std::round(50 * x) / 50;
    CloudPartOptions options;
    if (random.coin()) options.blocks = random.integer(1, 3);
    if (random.coin()) options.sample = std::max<Index>(1, points.rows() / random.integer(2, 500));
    if (random.integer(0, 3) == 0) options.threshold = random.real() / 10;
    const RipsOptions as_one{.threshold = options.threshold};
    const auto expected = all_pairs(Rips(points, as_one));
    const CloudPart whole = joined(random, parts_of(points, random.integer(1, 9), options));
    ASSERT_EQ(all_pairs(whole.rips()), expected);
  });
}

// A part is computed without the other parts. It holds only its block and the points near the
// block.
TEST(CloudPart, LeavesOutWhatIsFar) {
  Generator random(1);
  const Points points = random.points(200000, 2, false);
  RunContext of_one, of_part;
  const Rips one = Rips::borrowed(points, {}, of_one);
  one.graph(RipsForm::forest, of_one);
  const CloudPart part(points, 3, 16, {}, of_part);
  EXPECT_LT(of_part.memory.peak(), of_one.memory.peak() / 6);
  // The bytes of a part are about 16 per point of its block, plus a little more.
  EXPECT_LT(part.bytes().size(), 200000 / 16 * 27);
}

// Coordinates differ by hundreds of orders of magnitude, and squares of some of them are beyond the
// range of doubles.
TEST(CloudPart, OfCoordinatesOfAnySize) {
  for_each_seed(600, [&](Generator& random, bool ties, std::int64_t) {
    Points points = random_cloud(random, 40, ties);
    const int exponents[] = {600, -500, -480, -465, -440};
    for (Index i = 0; i < points.rows(); ++i)
      scale(points.row(i), std::ldexp(1, exponents[random.integer(0, 4)]));
    if (random.coin()) points(0, 0) = 1;
    const auto expected = all_pairs(Rips(points));
    const auto options = CloudPartOptions{.sample = random.integer(1, int(points.rows()))};
    const int count = random.integer(1, 5);
    ASSERT_EQ(all_pairs(joined(random, parts_of(points, count, options)).rips()), expected);
  });
}

TEST(CloudPart, OfRowsThatAreNotSideBySide) {
  Generator random(3);
  const Points points = random.points(300, 3, false);
  std::vector<double> columns;
  for (Index k = 0; k < 3; ++k)
    for (Index i = 0; i < 300; ++i) columns.push_back(points(i, k));
  const PointsView view(columns.data(), 300, 3, 1, 300);
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(CloudPart(view, i, 4).bytes(), CloudPart(points, i, 4).bytes());
}

TEST(CloudPart, OfFewOrNone) {
  Generator random(4);
  for (const Index n : {0, 1, 2, 3})
    for (const Index d : {0, 1, 8})
      for (const int count : {1, 2, 7}) {
        const Points points = random.points(n, d, false);
        const CloudPart whole = joined(random, parts_of(points, count, {}));
        EXPECT_EQ(all_pairs(whole.rips()), all_pairs(Rips(points)));
      }
}

TEST(CloudPart, WhatIsKeptDoesNotDependOnGroupsAndThreads) {
  for_each_seed(300, [](Generator& random, bool ties, std::int64_t) {
    const Points points = random_cloud(random, 200, ties);
    const CloudPartOptions options = random_options(random, points.rows(), ties);
    const int count = random.integer(3, 7);
    const auto some = [&](const RunContext& context) {
      auto parts = parts_of(points, count, options, context);
      parts.erase(parts.begin() + 1);  // the second part is missing
      return joined(random, std::move(parts)).bytes();
    };
    ThreadsContext threads(3);
    const auto bytes = some(default_context());
    ASSERT_EQ(some(threads), bytes);
    CloudPart part = CloudPart::of_bytes(bytes);
    ASSERT_EQ(part.missing(), std::vector<int>{1});
    part.join(CloudPart(points, 1, count, options));
    ASSERT_TRUE(part.is_whole());
    const auto joined_again = joined(random, parts_of(points, count, options)).bytes();
    ASSERT_EQ(part.bytes(), joined_again);
  });
}

TEST(CloudPart, RefusesWhatDoesNotBelongTogether) {
  Generator random(5);
  const Points points = random.points(50, 2, false);
  Points other = points;
  other(49, 1) += 1;
  CloudPart first(points, 0, 3);
  const auto bytes = first.bytes();
  const auto refused = [&](CloudPart part, const char* why) {
    expect_error(ErrorKind::bad_data, why, [&] { first.join(std::move(part)); });
    EXPECT_EQ(first.bytes(), bytes);
  };
  refused(CloudPart(other, 1, 3), "differ in points, options or number of parts");
  refused(CloudPart(points, 1, 4), "differ in points, options or number of parts");
  refused(CloudPart(points, 1, 3, {.threshold = 1}),
          "differ in points, options or number of parts");
  refused(CloudPart(points, 1, 3, {.blocks = 2}), "differ in points, options or number of parts");
  refused(CloudPart(points, 1, 3, {.sample = 7}), "differ in points, options or number of parts");
  refused(CloudPart(points, 0, 3), "found part 1 twice");
  first.join(CloudPart(points, 2, 3));
  EXPECT_EQ(first.missing(), std::vector<int>{1});
  EXPECT_EQ(first.present(), (std::vector<int>{0, 2}));
  EXPECT_EQ(std::pair(first.points(), first.coordinates()), std::pair(Index{50}, Index{2}));
  EXPECT_FALSE(first.is_whole());
}

TEST(CloudPart, RefusesPartsAndCloudsThatAreNone) {
  Generator random(6);
  Points points = random.points(9, 2, false);
  const auto refused = [&](PointsView of, int part, int parts, const CloudPartOptions& options,
                           const char* why) {
    expect_error(ErrorKind::usage, why, [&] { CloudPart(of, part, parts, options); });
  };
  refused(points, 0, 0, {}, "found 0 parts, expected 1 to 2^30");
  refused(points, 0, (1 << 30) + 1, {}, "found 1073741825 parts, expected 1 to 2^30");
  refused(points, 3, 3, {}, "found part 4 of 3");
  refused(points, -1, 3, {}, "found part 0 of 3");
  refused(points, 0, 1, {.threshold = -1}, "threshold -1");
  refused(points, 0, 1, {.threshold = std::nan("")}, "threshold nan");
  refused(points, 0, 1, {.distance = PointDistance::manhattan},
          "found distance manhattan, expected euclidean");
  refused(points, 0, 1, {.blocks = -1}, "found -1 blocks");
  refused(points, 0, 1, {.sample = 10},
          "found a sample of 10, expected 0 to the number of points, 9");
  refused(Points(2, 9), 0, 1, {}, "found 9 coordinates, expected at most 8");
  for (Index i = 0; i < 9; ++i) {
    Points bad = points;
    bad(i, 1) = kInfinity;
    expect_error(ErrorKind::bad_data, "coordinate 1: found inf", [&] { CloudPart(bad, 0, 2); });
  }
}

TEST(CloudPart, StopsAndKeepsToItsMemory) {
  Generator random(7);
  const Points points = random.points(20000, 3, false);
  StoppedContext stopped;
  expect_error(ErrorKind::cancelled, "", [&] { CloudPart(points, 0, 2, {}, stopped); });
  LimitedContext small(500000);
  expect_error(ErrorKind::resource, "memory", [&] { CloudPart(points, 0, 2, {}, small); });
}

// Replaces a part by a part of another cloud that claims to belong to this cloud. The replacement
// joins too few points or the wrong points. Such an error is detected in nearly all cases.
TEST(CloudPart, FindsEdgesThatAreMissing) {
  constexpr std::size_t fingerprint = 40, bytes_of_it = 8;
  int found = 0, counted = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Generator random(seed);
    const Points points = random.points(60, 2, false);
    Points other = points;
    for (Index i = 0; i < 60; i += 3) other(i, 0) += 0.2 * random.real();
    const CloudPartOptions options{.threshold = seed % 2 == 0 ? std::nullopt : std::optional(9.0),
                                   .sample = 12};
    auto parts = parts_of(points, 3, options);
    const auto own = parts[1].bytes();
    const auto bytes = CloudPart(other, 1, 3, options).bytes();
    const auto said = content_of_part(bytes, "cloud");
    std::vector<std::byte> content(said.begin(), said.end());
    std::ranges::copy(content_of_part(own, "cloud").subspan(fingerprint, bytes_of_it),
                      content.begin() + fingerprint);
    parts[1] = CloudPart::of_bytes(sealed_part("cloud", content));
    try {
      joined(random, std::move(parts)).barcode();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::bad_data);
      const std::string what = error.what();
      const bool is_about_edges = what.find("not joined as the parts claim") != std::string::npos;
      EXPECT_TRUE(is_about_edges || what.find("more points than the 60") != std::string::npos);
      ++(is_about_edges ? found : counted);
    }
    ++all;
  }
  EXPECT_GT(found + counted, all / 10 * 9);
  EXPECT_GT(found, all / 4);
}

// Checks that every truncation, every flipped bit and an appended byte are detected.
TEST(CloudPart, RefusesDamagedBytes) {
  Generator random(8);
  const Points points = random.points(40, 2, true);
  const std::vector<std::byte> bytes = CloudPart(points, 1, 3).bytes();
  const auto is_refused = [&](std::span<const std::byte> damaged) {
    return fails_with(ErrorKind::bad_data, [&] { CloudPart::of_bytes(damaged); });
  };
  EXPECT_FALSE(is_refused(bytes));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_TRUE(is_refused(std::span(bytes).first(size))) << size;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      auto damaged = bytes;
      damaged[i] ^= std::byte(1 << bit);
      ASSERT_TRUE(is_refused(damaged)) << i;
    }
  auto longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_TRUE(is_refused(longer));
}

}  // namespace
}  // namespace ph::test
