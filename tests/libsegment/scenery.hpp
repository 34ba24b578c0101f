// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "ph/segment.hpp"

/// Small scenes with known labels.
namespace ph::segment::test {

/// The name of a method, for use in names of tests.
inline const char* name_of(Method method) {
  return method == Method::paper ? "Paper" : method == Method::surface ? "Surface" : "Supervoxels";
}

inline constexpr float kHole = std::numeric_limits<float>::quiet_NaN();

/// An organised cloud made of triples of coordinates.
inline Cloud cloud_of(const std::vector<float>& xyz, Index width, Index height) {
  Cloud cloud;
  cloud.width = width;
  cloud.height = height;
  cloud.fields = {{"x", FieldType::float32, 1, 0},
                  {"y", FieldType::float32, 1, 4},
                  {"z", FieldType::float32, 1, 8}};
  cloud.stride = 12;
  cloud.data.resize(xyz.size() * sizeof(float));
  if (!xyz.empty()) std::memcpy(cloud.data.data(), xyz.data(), cloud.data.size());
  return cloud;
}

/// An object in the path of rays: a box whose sides are parallel to the table's axes.
struct Block {
  Vec3 min, max;
};

/// A camera 1 m from a table, looking down at 45 degrees. The table's coordinates are x right, y
/// away and z up, with the origin in its middle. The picture has 320 x 240 pixels, and the cloud
/// has the axes of the camera (x right, y down, z forward). Rays that miss the table (1.2 m x 1 m)
/// become holes. Rays that graze the left or right side of a box become holes as well, as with real
/// sensors.
class TableScene {
 public:
  static constexpr Index kWidth = 320, kHeight = 240;

  /// @param finer factor for the number of pixels along each axis.
  explicit TableScene(std::vector<Block> blocks, double finer = 1) : blocks_(std::move(blocks)) {
    width_ = static_cast<Index>(std::lround(kWidth * finer));
    height_ = static_cast<Index>(std::lround(kHeight * finer));
    for (Index v = 0; v < height_; ++v) {
      for (Index u = 0; u < width_; ++u)
        cast((static_cast<double>(u) + 0.5) / finer - 160,
             (static_cast<double>(v) + 0.5) / finer - 120);
    }
  }
  /// A table with two boxes, 20 cm apart. The left box has sides of 12 cm, and the right box of 10
  /// cm.
  static TableScene two_boxes() {
    return TableScene(
        {{{-0.22, -0.05, 0}, {-0.10, 0.07, 0.12}}, {{0.10, -0.05, 0}, {0.2, 0.05, 0.1}}});
  }

  const std::vector<float>& xyz() const { return xyz_; }
  /// The object that each pixel shows: -1 for nothing, 0 for the table, and 1… for the blocks.
  const std::vector<int>& truth() const { return truth_; }
  Cloud cloud() const { return cloud_of(xyz_, width_, height_); }

 private:
  /// Follows the ray through a pixel. u and v are the distances of the pixel from the middle of the
  /// picture.
  void cast(double u, double v) {
    // The camera is at (0, -1/sqrt 2, 1/sqrt 2). Forward is (0, c, -c), down is (0, -c, -c), and
    // right is (1, 0, 0).
    const double c = std::sqrt(0.5);
    const Vec3 eye{0, -c, c};
    const double px = u / 260, py = v / 260;
    const Vec3 ray{px, c - c * py, -c - c * py};
    double nearest = std::numeric_limits<double>::infinity();
    int hit = -1;
    const double table = -eye[2] / ray[2];
    const double tx = eye[0] + table * ray[0], ty = eye[1] + table * ray[1];
    if (table > 0 && std::abs(tx) < 0.6 && std::abs(ty) < 0.5) {
      nearest = table;
      hit = 0;
    }
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      double enter = 0, leave = std::numeric_limits<double>::infinity();
      std::size_t face = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double a = (blocks_[b].min[axis] - eye[axis]) / ray[axis];
        const double z = (blocks_[b].max[axis] - eye[axis]) / ray[axis];
        if (std::min(a, z) > enter) {
          enter = std::min(a, z);
          face = axis;
        }
        leave = std::min(leave, std::max(a, z));
      }
      if (enter < leave && enter < nearest) {
        nearest = enter;
        hit = face == 0 ? -1 : static_cast<int>(b + 1);
      }
    }
    truth_.push_back(hit);
    const float depth = hit < 0 ? kHole : static_cast<float>(nearest);
    xyz_.push_back(static_cast<float>(px) * depth);
    xyz_.push_back(static_cast<float>(py) * depth);
    xyz_.push_back(depth);
  }

  std::vector<Block> blocks_;
  Index width_ = 0, height_ = 0;
  std::vector<float> xyz_;
  std::vector<int> truth_;
};

/// The indices of all points.
inline std::vector<Index> all_of(const std::vector<float>& xyz) {
  std::vector<Index> points(xyz.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = static_cast<Index>(i);
  return points;
}

}  // namespace ph::segment::test
