// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>

#include <vector>

#include "ph/parts/image_part.hpp"
#include "support/generators.hpp"

namespace ph::test {

/// An image with what is wanted of it in parts.
struct ImageCase {
  Image image;
  ImagePartOptions options;
  int layers;  ///< so many parts there may be
};
/// Ties, holes, infinities, axes of one voxel or that close up, thresholds; both constructions.
inline ImageCase random_image_case(Generator& random) {
  const int axes = random.integer(2, 3), most = axes == 2 ? 9 : 5;
  ImageCase result{{}, {}, 0};
  std::vector<Index> extents;
  for (int k = 0; k < axes; ++k) extents.push_back(random.integer(2, most));
  result.layers = static_cast<int>(extents[0]);
  if (random.coin()) extents.insert(extents.begin() + random.integer(0, axes), 1);
  CubicalOptions& cubical = result.options.cubical;
  cubical = random.cubical_options(static_cast<int>(extents.size()));
  if (random.coin()) cubical.periodic[extents[0] == 1 ? 1 : 0] = true;
  result.image = random.image(extents, random.coin());
  if (random.integer(0, 3) == 0) cubical.threshold = random.integer(-2, 3);
  // An axis of one voxel is one of the T-construction's, if it has ends.
  int kept = 0;
  for (std::size_t k = 0; k < extents.size(); ++k) {
    const bool is_kept =
        extents[k] > 1 ||
        (cubical.construction == CubicalOptions::Construction::cells && !cubical.periodic[k]);
    if (is_kept && kept++ == 0) result.layers = static_cast<int>(extents[k]);
  }
  if (kept == 3) {
    if (random.coin())
      result.options.max_dim = 0;
    else
      result.options.min_dim = 2;
  }
  return result;
}

/// The first layers of so many parts, of any sizes.
inline std::vector<Index> random_first_layers(Generator& random, int layers, int parts) {
  std::vector<Index> first{0};
  for (int left = parts - 1; left > 0; --left) {
    const auto next = static_cast<int>(first.back()) + 1;
    first.push_back(random.integer(next, random.coin() ? next : layers - left));
  }
  return first;
}

/// Whether a volume has bars of dimension 1, or what needs them, among all that are wanted.
inline bool is_refused(const ImageCase& c) {
  try {
    ImagePart(c.image, 0, 1, c.options);
    return false;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    return true;
  }
}

}  // namespace ph::test
