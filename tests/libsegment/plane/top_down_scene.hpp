// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "ph/segment.hpp"
#include "tests/support/generators.hpp"

namespace ph::segment::test {

/// A camera that looks down on a table, as in bin picking. The camera is at the origin and looks
/// along z, and the foot of the perpendicular from the camera to the table is in the picture. Boxes
/// with any rotation stand on the table, in the middle of the picture and around it.
class TopDownScene {
 public:
  template <class Random>
  explicit TopDownScene(Random& random) {
    const double turn = 2 * std::numbers::pi * random.real();
    const double tilt = random.coin() ? 0 : 0.35 * random.real();
    const double height = 0.4 + random.real();
    up_ = {std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), -std::cos(tilt)};
    foot_ = -height * up_;
    const double yaw = random.coin() ? 0 : 2 * std::numbers::pi * random.real();
    right_ = Eigen::AngleAxisd(yaw, up_) * up_.cross(Eigen::Vector3d::UnitY()).normalized();
    away_ = up_.cross(right_);
    spacing_ = 0.003 + 0.002 * random.real();
    place_boxes(random);
    constexpr int width = 150, rows = 110;
    for (int v = 0; v < rows; ++v)
      for (int u = 0; u < width; ++u)
        cast(random, (u + 0.5 - width / 2.0) * spacing_ / height,
             (v + 0.5 - rows / 2.0) * spacing_ / height);
    // Adds many points around the foot, where the coordinates of the squares change their signs.
    for (int i = 0; i < 100; ++i)
      cast(random, (foot_[0] + 0.01 * (random.real() - 0.5)) / foot_[2],
           (foot_[1] + 0.01 * (random.real() - 0.5)) / foot_[2]);
  }

  const std::vector<float>& xyz() const { return xyz_; }
  std::size_t box_count() const { return boxes_.size(); }
  /// The object of each point: 0 for the table, and 1… for the boxes.
  const std::vector<std::size_t>& truth() const { return truth_; }
  /// The distance on the table from a point of the table to the foot of the nearest box.
  double to_nearest_box(std::size_t point) const {
    const auto [x, y, z] = on_table(
        {double{xyz_[3 * point]}, double{xyz_[3 * point + 1]}, double{xyz_[3 * point + 2]}});
    double nearest = kInfinity;
    for (const Block& b : boxes_)
      nearest = std::min(nearest, std::hypot(std::max({b.x - x, 0.0, x - b.x - b.width}),
                                             std::max({b.y - y, 0.0, y - b.y - b.depth})));
    return nearest;
  }

 private:
  /// A box on the table, in metres. x and width are along the axis `right`, and y and depth along
  /// the axis `away`. The position is relative to the foot of the perpendicular.
  struct Block {
    double x, y, width, depth, height;
  };
  struct OnTable {
    double x, y, z;
  };
  OnTable on_table(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d q = p - foot_;
    return {q.dot(right_), q.dot(away_), q.dot(up_)};
  }

  /// Places random boxes such that any two boxes are at least 6 cm apart.
  template <class Random>
  void place_boxes(Random& random) {
    constexpr double gap = 0.06;
    const int wanted = random.integer(0, 4);
    for (int tries = 0; tries < 20 && static_cast<int>(boxes_.size()) < wanted; ++tries) {
      Block b{0, 0, 0.06 + 0.06 * random.real(), 0.06 + 0.06 * random.real(),
              0.03 + 0.07 * random.real()};
      const double reach = random.coin() ? 0.03 : 0.2;  // near the middle, or anywhere
      b.x = reach * (2 * random.real() - 1) - b.width / 2;
      b.y = reach * (2 * random.real() - 1) - b.depth / 2;
      if (std::ranges::all_of(boxes_, [&](const Block& o) {
            return b.x > o.x + o.width + gap || o.x > b.x + b.width + gap ||
                   b.y > o.y + o.depth + gap || o.y > b.y + b.depth + gap;
          }))
        boxes_.push_back(b);
    }
  }

  /// Adds the point that the ray (px, py, 1) meets first, with noise along the ray.
  template <class Random>
  void cast(Random& random, double px, double py) {
    const Eigen::Vector3d ray(px, py, 1);
    const OnTable eye = on_table(Eigen::Vector3d::Zero());
    const double dx = ray.dot(right_), dy = ray.dot(away_), dz = ray.dot(up_);
    double nearest = -eye.z / dz;
    std::size_t hit = 0;
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      const Block& b = boxes_[k];
      double enter = 0, leave = kInfinity;
      const auto clip = [&](double from, double by, double low, double high) {
        if (by == 0) {
          if (from < low || from > high) leave = -1;
          return;
        }
        enter = std::max(enter, std::min((low - from) / by, (high - from) / by));
        leave = std::min(leave, std::max((low - from) / by, (high - from) / by));
      };
      clip(eye.x, dx, b.x, b.x + b.width);
      clip(eye.y, dy, b.y, b.y + b.depth);
      clip(eye.z, dz, 0, b.height);
      if (enter < leave && enter < nearest) {
        nearest = enter;
        hit = k + 1;
      }
    }
    // The noise is a sum of uniform numbers with a standard deviation of 0.8 mm. A tenth of the
    // table's points are so high that the bases of objects may take them.
    const double noise = random.real() + random.real() + random.real() - 1.5;
    const double depth = nearest + 0.0016 * noise;
    truth_.push_back(hit);
    for (const double c : {px, py, 1.0}) xyz_.push_back(static_cast<float>(c * depth));
  }

  Eigen::Vector3d up_, foot_, right_, away_;
  double spacing_;
  std::vector<Block> boxes_;
  std::vector<float> xyz_;
  std::vector<std::size_t> truth_;
};

/// Checks that a stored tree is read back and cut to the same labels.
inline void expect_read_back(const Segmentation& s) {
  const std::string bytes = tree_bytes(s.tree);
  const SceneTree again = read_tree(Input::view(bytes, "scene.tree"));
  EXPECT_EQ(cut(again, again.first_cut).labels, s.cut.labels);
}

/// Segments the scene and compares the labels with the known answer.
inline void expect_right(const TopDownScene& scene, Method method) {
  const Segmentation s = segment(CloudView{scene.xyz(), {}}, {.method = method});
  ASSERT_TRUE(s.tree.plane);
  // Within this distance, a box may take points from the table.
  const double beside = 2 * s.tree.voxel + 0.005;
  std::map<std::uint32_t, std::size_t> box_of_label;
  std::vector<std::map<std::uint32_t, Index>> labels_of_box(scene.box_count() + 1);
  for (std::size_t i = 0; i < s.cut.labels.size(); ++i) {
    const std::uint32_t label = s.cut.labels[i];
    const std::size_t box = scene.truth()[i];
    if (box > 0) ++labels_of_box[box][label];
    if (label == 0) continue;
    if (box == 0) {
      ASSERT_LE(scene.to_nearest_box(i), beside)
          << "point " << i << " of the table has label " << label;
    } else if (method != Method::supervoxels) {
      ASSERT_EQ(box_of_label.try_emplace(label, box).first->second, box)
          << "label " << label << " on two boxes, point " << i;
    }
  }
  for (std::size_t box = 1; box < labels_of_box.size(); ++box) {
    Index points = 0, without = 0;
    for (const auto& [label, count] : labels_of_box[box]) {
      points += count;
      if (label == 0) without += count;
    }
    // Low points on the sides of a box may be taken for the plane. If the border of the picture
    // cuts the box, the rest of the box may be too small.
    if (points >= 800) {
      EXPECT_LT(2 * without, points) << "box " << box << " without a label";
    }
  }
  expect_read_back(s);
}

}  // namespace ph::segment::test
