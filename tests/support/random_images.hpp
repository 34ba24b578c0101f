// SPDX-License-Identifier: MIT
#pragma once
// Checks the representatives of the bars of a random image.
#include <limits>

#include "tests/support/generators.hpp"
#include "tests/support/voxel_sets.hpp"

namespace ph::test {

/// A small image of up to three axes, in which some voxels never enter, and its options.
struct RandomImage {
  Image image;
  CubicalOptions options;

  RandomImage(Generator& random, bool ties, int most_of_three) {
    const int axes = random.integer(1, 3);
    const int most[] = {0, 12, 6, most_of_three};
    std::vector<Index> extents;
    for (int k = 0; k < axes; ++k) extents.push_back(random.integer(1, most[axes]));
    image = random.image(extents, ties);
    options = random.cubical_options(axes);
    if (random.integer(0, 3) == 0)
      options.threshold =
          (options.superlevel ? -1 : 1) * (ties ? random.integer(0, 3) : random.real());
    image.masked = random.coin();
    const double never = image.masked         ? std::numeric_limits<double>::quiet_NaN()
                         : options.superlevel ? -kInfinity
                                              : kInfinity;
    if (random.integer(0, 2) == 0)
      for (int i = random.integer(1, 4); i-- > 0;) {
        const auto hole =
            static_cast<std::size_t>(random.integer(0, static_cast<int>(image.values.size()) - 1));
        image.values.change([&](auto& all) {
          using T = typename std::remove_cvref_t<decltype(all)>::value_type;
          all[hole] = static_cast<T>(never);
        });
      }
  }
};

inline void check_random_cycles(Generator& random, bool ties, std::int64_t field) {
  const RandomImage random_image(random, ties, 4);
  const Cubical cubical(random_image.image, random_image.options);
  const int max_dim = random.integer(0, 3);
  Options options{.max_dim = max_dim, .field = field, .engine = Engine::gradient};
  const auto pairs = pairs_of(persistence(cubical, options));
  options.representatives = Representatives::cycles;
  const Barcode bars = persistence(cubical, options);
  ASSERT_EQ(pairs_of(bars), pairs);
  const OrderedCells<Cubical> cells(cubical, std::min(max_dim, cubical.top_dim()) + 1, field);
  for (std::size_t i = 0; i < bars.size(); ++i) {
    SCOPED_TRACE("bar " + std::to_string(i) + " of dimension " + std::to_string(bars[i].dim));
    check_cycle(cells, bars, i);
  }
}

inline void check_sets(const Image& image, const CubicalOptions& cubical_options, int max_dim,
                       std::int64_t field) {
  const Cubical cubical(image, cubical_options);
  Options options{.max_dim = max_dim, .field = field, .engine = Engine::gradient};
  const auto pairs = pairs_of(persistence(cubical, options));
  options.representatives = Representatives::voxels;
  const Barcode bars = persistence(cubical, options);
  ASSERT_EQ(pairs_of(bars), pairs);
  check_voxel_sets(image, cubical_options, bars, field);
}

inline void check_random_sets(Generator& random, bool ties, std::int64_t field) {
  const RandomImage random_image(random, ties, 5);
  check_sets(random_image.image, random_image.options, random.integer(0, 3), field);
}

}  // namespace ph::test
