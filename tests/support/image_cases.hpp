// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "ph/parts/image_part.hpp"
#include "tests/support/generators.hpp"

namespace ph::test {

/// An image, and the results that are requested from its parts.
struct ImageCase {
  Image image;
  ImagePartOptions options;
  int layers;  ///< the largest number of parts
};

/// The axes of an image that parts take into account. An axis of one voxel counts only in the
/// T-construction, and only if it is not periodic.
struct KeptAxes {
  int count = 0, layers = 0;
  /// The number of periodic axes with one voxel. Each of them adds a copy of every bar.
  int copies = 0;
  bool closes = false;  ///< true if one of the kept axes is periodic
};
inline KeptAxes kept_axes(const std::vector<Index>& extents, const CubicalOptions& options) {
  KeptAxes kept;
  for (std::size_t k = 0; k < extents.size(); ++k) {
    const bool closes = k < options.periodic.size() && options.periodic[k];
    if (extents[k] == 1 &&
        (closes || options.construction == CubicalOptions::Construction::vertices)) {
      kept.copies += closes ? 1 : 0;
      continue;
    }
    if (kept.count++ == 0) kept.layers = static_cast<int>(extents[k]);
    kept.closes = kept.closes || closes;
  }
  return kept;
}

/// A random image with two or three axes of several voxels, for either construction. It may have
/// ties, holes, infinities, one more axis of one voxel, periodic axes and a threshold.
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
  const KeptAxes kept = kept_axes(extents, cubical);
  if (kept.count > 0) result.layers = kept.layers;
  if (kept.count == 3) {
    if (random.coin())
      result.options.max_dim = 0;
    else
      result.options.min_dim = 2;
  }
  return result;
}

/// A random image with four or five axes, in which voxels may be absent. If parts take at least
/// three of the axes into account, requests either the components or the bars of the second-highest
/// dimension. To create bars of this dimension, low voxels surround high voxels.
inline ImageCase random_case_of_many_axes(Generator& random) {
  const int axes = random.integer(0, 3) == 0 ? 5 : 4, most = axes == 4 ? 4 : 3;
  const bool has_hollows = random.coin();
  ImageCase result{{}, {}, 0};
  std::vector<Index> extents;
  for (int k = 0; k < axes; ++k) extents.push_back(random.integer(has_hollows ? 3 : 1, most));
  if (random.coin()) extents[0] = random.integer(has_hollows ? 3 : 2, 6);
  CubicalOptions& cubical = result.options.cubical;
  cubical = random.cubical_options(axes);
  if (has_hollows || random.coin()) cubical.periodic.assign(extents.size(), false);
  if (random.integer(0, 3) == 0) cubical.periodic[0] = true;
  if (random.integer(0, 3) == 0) cubical.threshold = random.integer(-2, 3);
  result.image = random.image(extents, random.integer(0, 3) > 0);
  if (has_hollows) {
    std::vector<double> values;
    while (values.size() < result.image.values.size()) values.push_back(random.integer(0, 1));
    for (int spikes = random.integer(1, 4); spikes > 0; --spikes) {
      std::size_t inside = 0;
      for (const Index n : extents)
        inside = inside * static_cast<std::size_t>(n) +
                 static_cast<std::size_t>(n < 3 ? 0 : random.integer(1, static_cast<int>(n) - 2));
      values[inside] = random.integer(2, 5);
    }
    if (cubical.superlevel)
      for (double& v : values) v = -v;
    result.image.values = std::move(values);
  }
  if (random.integer(0, 3) == 0) {
    result.image.masked = true;
    std::vector<double> values = result.image.values.doubles();
    for (double& v : values)
      if (random.integer(0, 19) == 0) v = std::numeric_limits<double>::quiet_NaN();
    result.image.values = std::move(values);
  }
  const KeptAxes kept = kept_axes(extents, cubical);
  result.layers = kept.layers;
  if (kept.count < 3) return result;
  if (kept.closes || !has_hollows)
    result.options.max_dim = 0;
  else
    result.options.min_dim = kept.count - 1 + kept.copies;
  return result;
}

inline std::vector<ImagePart> parts_of(const Image& image, int count,
                                       const ImagePartOptions& options,
                                       const RunContext& context = default_context()) {
  std::vector<ImagePart> parts;
  for (int i = 0; i < count; ++i) parts.emplace_back(image, i, count, options, context);
  return parts;
}

/// Joins neighbouring parts in a random order until one is left. Occasionally, a part is written to
/// bytes and read back.
inline ImagePart joined(Generator& random, std::vector<ImagePart> parts) {
  while (parts.size() > 1) {
    const auto i = static_cast<std::size_t>(random.integer(0, static_cast<int>(parts.size()) - 2));
    if (random.integer(0, 2) == 0) {
      const auto bytes = parts[i].bytes();
      parts[i] = ImagePart::of_bytes(bytes);
      EXPECT_EQ(parts[i].bytes(), bytes);
    }
    parts[i].join(std::move(parts[i + 1]));
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  }
  return std::move(parts[0]);
}

/// Random first layers for `parts` parts, so that the parts have random sizes.
inline std::vector<Index> random_first_layers(Generator& random, int layers, int parts) {
  std::vector<Index> first{0};
  for (int left = parts - 1; left > 0; --left) {
    const auto next = static_cast<int>(first.back()) + 1;
    first.push_back(random.integer(next, random.coin() ? next : layers - left));
  }
  return first;
}

/// True if parts refuse the requested results. Parts refuse bars between dimension 0 and the
/// second-highest dimension, except for loops of volumes if the option `loops` is set.
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
