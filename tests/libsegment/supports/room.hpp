// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "ph/segment.hpp"
#include "tests/libsegment/scenery.hpp"

namespace ph::segment::test {

/// Blocks as seen by a sensor at (0, -0.9, 0.9) that looks down at 45 degrees. The coordinates of
/// the points are x right, y away and z up. At one metre, depth has noise of half a millimetre.
class Room {
 public:
  static constexpr Index kWidth = 640, kHeight = 480;

  explicit Room(const std::vector<Block>& blocks) {
    std::mt19937 random(3);
    std::normal_distribution<double> gauss;
    const double c = std::sqrt(0.5), focal = 340;
    for (Index v = 0; v < kHeight; ++v) {
      for (Index u = 0; u < kWidth; ++u) {
        const double px = (static_cast<double>(u) - kWidth / 2.0 + 0.5) / focal;
        const double py = (static_cast<double>(v) - kHeight / 2.0 + 0.5) / focal;
        const Vec3 ray{px, c - c * py, -c - c * py};
        double depth = kInfinity;
        int met = -1;
        for (std::size_t b = 0; b < blocks.size(); ++b)
          if (const double at = entry(blocks[b], ray); at < depth) {
            depth = at;
            met = static_cast<int>(b);
          }
        depth += 0.0005 * depth * depth * gauss(random);
        met_.push_back(met);
        for (std::size_t k = 0; k < 3; ++k)
          xyz_.push_back(met < 0 ? test::kHole : static_cast<float>(kEye[k] + depth * ray[k]));
      }
    }
  }
  CloudView view() const { return {xyz_, kEye, kWidth, kHeight}; }
  Segmentation segmented(SegmentOptions options = {}) const {
    options.max_range = 4;
    options.viewpoint = kEye;
    return segment(view(), options);
  }
  /// The label of most points of a block.
  std::uint32_t label_of(const Segmentation& s, int block) const {
    std::vector<int> count(s.cut.segments.size() + 1);
    for (std::size_t i = 0; i < met_.size(); ++i)
      if (met_[i] == block) ++count[s.cut.labels[i]];
    return static_cast<std::uint32_t>(std::ranges::max_element(count) - count.begin());
  }
  /// The share of a block's points that are on a surface.
  double share_on(const Segmentation& s, int block, int surface) const {
    double all = 0, on = 0;
    for (std::size_t i = 0; i < met_.size(); ++i) {
      if (met_[i] != block) continue;
      ++all;
      on += s.cut.surface_labels[i] == surface ? 1 : 0;
    }
    return on / all;
  }

 private:
  static constexpr Vec3 kEye{0, -0.9, 0.9};

  /// The distance along a ray to the place where it enters a block.
  static double entry(const Block& block, const Vec3& ray) {
    double near = 0, far = kInfinity;
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = (block.min[k] - kEye[k]) / ray[k], b = (block.max[k] - kEye[k]) / ray[k];
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return near > 0 && near < far ? near : kInfinity;
  }

  std::vector<float> xyz_;
  std::vector<int> met_;  // the block that each pixel shows; -1 for none
};

inline const Block kTable{{-0.6, -0.5, -0.02}, {0.6, 0.5, 0}};
inline const Block kLeft{{-0.09, -0.05, 0}, {0.03, 0.07, 0.12}};
inline const Block kRight{{0.1, -0.05, 0}, {0.2, 0.05, 0.1}};
inline const Block kWall{{-0.4, 0.6, -0.1},
                         {0.4, 0.62, 1.5}};  // taller than the height of the sensor

inline void expect_direction(const Vec3& found, const Vec3& expected) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], 0.02) << k;
}

}  // namespace ph::segment::test
