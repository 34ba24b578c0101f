// SPDX-License-Identifier: MIT
#include "ph/detail/segment/cloud_picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "ph/detail/segment/colouring.hpp"
#include "ph/eigen.hpp"

namespace ph::segment {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSide = 1040;  // in pixels
constexpr int kFiner = 2;       // the picture is drawn this many times larger, then averaged
constexpr double kMargin = 0.12;
// The brightness of points with neither colour nor normal.
constexpr int kUsual = 190;
// Points nearer to the eye than this share of the eye's distance count as behind the eye.
constexpr double kNearest = 0.02;

Vector3d vector(const Vec3& v) { return {v[0], v[1], v[2]}; }

/// The points that are drawn, which are all points except holes.
struct Shown {
  std::vector<Vector3d> points;
  std::vector<std::uint32_t> colours, labels;
  std::vector<std::uint32_t> segments;  ///< indices of the points in a segment
};

/// The colour of a segment, mixed with the brightness of the point as the camera saw it.
std::uint32_t shaded(std::uint32_t colour, int grey) {
  std::uint32_t result = 0;
  for (const int shift : {16, 8, 0}) {
    const int channel = static_cast<int>(colour >> shift & 255U);
    result |= static_cast<std::uint32_t>((3 * channel + grey) / 4) << shift;
  }
  return result;
}

std::uint32_t light_grey(int grey) {
  const auto light = static_cast<std::uint32_t>(255 - (255 - grey) * 2 / 5);
  return light << 16 | light << 8 | light;
}

/// The brightness of a surface with these normals that is lit from the sensor's position.
std::vector<int> lit(const SceneTree& scene) {
  constexpr int dark = 40;
  const Vector3d eye = vector(scene.viewpoint);
  std::vector<int> grey(scene.cells.size(), kUsual);
  for (Index v = 0; v < scene.normals.rows(); ++v) {
    const Vector3d normal = as_matrix(scene.normals).row(v),
                   ray = as_matrix(scene.vertices).row(v).transpose() - eye;
    const double facing = std::abs(normal.dot(ray)) / ray.norm();
    if (std::isfinite(facing))
      grey[static_cast<std::size_t>(v)] = dark + static_cast<int>((255 - dark) * facing);
  }
  return grey;
}

Shown shown(const Cloud* cloud, const SceneTree& scene, std::span<const std::uint32_t> labels,
            std::span<const std::uint32_t> colours) {
  const std::vector<float> xyz = cloud ? cloud->xyz() : scene.xyz;
  const bool coloured = cloud && cloud->rgb();
  const std::vector<int> grey = coloured ? brightness(*cloud) : lit(scene);
  Shown shown;
  std::size_t next = 0;  // index among the points with a vertex
  for (std::size_t k = 0; k < xyz.size() / 3; ++k) {
    const std::size_t i = cloud ? k : static_cast<std::size_t>(scene.points[k]);
    const bool has_vertex = next < scene.points.size() && std::cmp_equal(scene.points[next], i);
    const std::size_t vertex = has_vertex ? scene.vertex_of_point[next++] : 0;
    const Vector3d point(xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]);
    if (!point.allFinite()) continue;
    const int g = coloured ? grey[i] : has_vertex ? grey[vertex] : kUsual;
    if (labels[i] != 0) shown.segments.push_back(static_cast<std::uint32_t>(shown.points.size()));
    shown.colours.push_back(labels[i] != 0 ? shaded(colours[labels[i] - 1], g) : light_grey(g));
    shown.labels.push_back(labels[i]);
    shown.points.push_back(point);
  }
  return shown;
}

/// The upward direction. An organised cloud is in a camera's frame, in which y points down. In
/// other clouds, the normal of the plane points up or, without a plane, z.
Vector3d up_of(const SceneTree& scene) {
  if (scene.height > 1) return {0, -1, 0};
  return scene.plane ? vector(scene.plane->normal) : Vector3d(0, 0, 1);
}

/// An eye with a direction, and the section of its view that fills the picture.
class Camera {
 public:
  Camera(const Shown& shown, const SceneTree& scene, const ViewTurn& turn) {
    Eigen::AlignedBox3d box;
    for_each_framed(shown, [&](const Vector3d& p) { box.extend(p); });
    if (box.isEmpty()) return;
    const Vector3d middle = box.center();
    const Vector3d from_sensor = middle - vector(scene.viewpoint);
    const double size = std::max(box.diagonal().norm(), 1e-9);
    // If the sensor is in the middle of the scene, the eye may be anywhere.
    const bool outside = from_sensor.norm() > 0.25 * size;
    forward_ = outside ? from_sensor.normalized() : Vector3d(0, 1, 0);
    distance_ = outside ? from_sensor.norm() : 2 * size;
    Vector3d up = up_of(scene);
    if (forward_.cross(up).norm() < 1e-6) up = forward_.unitOrthogonal();
    right_ = forward_.cross(up).normalized();
    constexpr double degree = std::numbers::pi / 180;
    // Turning around the normal of the plane keeps objects on it upright.
    const Vector3d upright = scene.plane ? vector(scene.plane->normal) : up;
    const Eigen::AngleAxisd around(turn.right * degree, upright.normalized());
    right_ = around * right_;
    forward_ = Eigen::AngleAxisd(-turn.up * degree, right_) * (around * forward_);
    down_ = forward_.cross(right_);
    eye_ = middle - distance_ * forward_;

    Eigen::AlignedBox2d seen;
    for_each_framed(shown, [&](const Vector3d& p) {
      if (const auto at = direction(p)) seen.extend(*at);
    });
    if (seen.isEmpty()) return;
    const double margin = std::max(kMargin * seen.sizes().maxCoeff(), 1e-9);
    low_ = seen.min().array() - margin;
    const Vector2d sizes = seen.sizes().array() + 2 * margin;
    scale_ = kSide * kFiner / sizes.maxCoeff();
    for (int axis = 0; axis < 2; ++axis)
      pixels_[static_cast<std::size_t>(axis)] =
          kFiner * std::max(1, static_cast<int>(std::ceil(scale_ * sizes[axis] / kFiner - 1e-6)));
  }

  int width() const { return pixels_[0]; }
  int height() const { return pixels_[1]; }
  double depth(const Vector3d& point) const { return (point - eye_).dot(forward_); }
  /// The position of a point, in pixels. Returns nothing if the point is behind the eye.
  std::optional<Vector2d> place(const Vector3d& point) const {
    const auto at = direction(point);
    if (!at) return std::nullopt;
    return scale_ * (*at - low_);
  }
  /// The number of pixels per unit of length at a depth.
  double scale_at(double depth) const { return scale_ / depth; }

 private:
  /// Visits the points of segments, or all points if there are no segments.
  template <class Visit>
  static void for_each_framed(const Shown& shown, Visit&& visit) {
    for (const std::uint32_t i : shown.segments) visit(shown.points[i]);
    if (shown.segments.empty())
      for (const Vector3d& point : shown.points) visit(point);
  }

  std::optional<Vector2d> direction(const Vector3d& point) const {
    const double z = depth(point);
    if (!(z > kNearest * distance_)) return std::nullopt;
    const Vector3d ray = point - eye_;
    return Vector2d(ray.dot(right_), ray.dot(down_)) / z;
  }

  Vector3d eye_ = Vector3d::Zero(), forward_ = Vector3d::UnitZ(), right_ = Vector3d::UnitX(),
           down_ = Vector3d::UnitY();
  double distance_ = 1, scale_ = 1;
  Vector2d low_ = Vector2d::Zero();
  std::array<int, 2> pixels_{kFiner, kFiner};
};

/// The distance between neighbouring points in metres, derived from the voxels. For a camera, this
/// distance grows with the range.
class Spacing {
 public:
  explicit Spacing(const SceneTree& scene)
      : viewpoint_(vector(scene.viewpoint)), grows_(scene.height > 1) {
    double points = 0, range = 0;
    for (const Index count : scene.counts) points += static_cast<double>(count);
    for (Index v = 0; v < scene.vertices.rows(); ++v)
      range += (as_matrix(scene.vertices).row(v).transpose() - viewpoint_).norm();
    const auto voxels = static_cast<double>(scene.counts.size());
    if (points > 0) mean_ = scene.voxel / std::sqrt(points / voxels);
    if (range > 0) mean_range_ = range / voxels;
  }
  double at(const Vector3d& point) const {
    return grows_ ? mean_ * (point - viewpoint_).norm() / mean_range_ : mean_;
  }

 private:
  Vector3d viewpoint_;
  bool grows_;
  double mean_ = 0, mean_range_ = 1;
};

constexpr std::uint32_t kNoPoint = std::numeric_limits<std::uint32_t>::max();

struct Pixel {
  float depth = std::numeric_limits<float>::infinity();
  std::uint32_t point = kNoPoint;
};

/// Draws each point as a square about as large as the piece of surface that it represents.
std::vector<Pixel> draw(const Shown& shown, const Camera& camera, const Spacing& spacing) {
  // `least` and `most` are in pixels.
  constexpr double least = 2, most = 40, overlap = 1.5;
  std::vector<Pixel> pixels(static_cast<std::size_t>(camera.width() * camera.height()));
  for (std::size_t i = 0; i < shown.points.size(); ++i) {
    const Vector3d& point = shown.points[i];
    const auto place = camera.place(point);
    if (!place) continue;
    const double depth = camera.depth(point);
    const double side =
        std::clamp(overlap * spacing.at(point) * camera.scale_at(depth), least, most);
    const auto first = [&](int axis) {
      return std::max(0.0, std::ceil((*place)[axis] - side / 2));
    };
    const auto last = [&](int axis, int size) {
      return std::min<double>(size, std::ceil((*place)[axis] + side / 2));
    };
    const auto z = static_cast<float>(depth);
    for (double y = first(1); y < last(1, camera.height()); ++y)
      for (double x = first(0); x < last(0, camera.width()); ++x) {
        Pixel& pixel =
            pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width()) +
                   static_cast<std::size_t>(x)];
        if (z < pixel.depth) pixel = {z, static_cast<std::uint32_t>(i)};
      }
  }
  return pixels;
}

/// Darkens a pixel next to something much nearer, so that outlines become visible. This is eye-dome
/// lighting (Boucheny 2009).
double light_at(const std::vector<Pixel>& pixels, int width, int height, int x, int y) {
  constexpr int reach = 3;
  constexpr double strength = 2.5, darkest = 0.45;
  const auto at = [&](int u, int v) {
    return pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(u)]
        .depth;
  };
  const float depth = at(x, y);
  double hidden = 0;
  for (const auto& [dx, dy] : {std::pair(-reach, 0), {reach, 0}, {0, -reach}, {0, reach}}) {
    const int u = x + dx, v = y + dy;
    if (u < 0 || v < 0 || u >= width || v >= height) continue;
    if (at(u, v) < depth) hidden += std::log2(depth / at(u, v));
  }
  return std::max(darkest, std::exp(-strength * hidden));
}

Raster averaged(const Shown& shown, const std::vector<Pixel>& pixels, int width, int height) {
  Raster raster{width / kFiner, height / kFiner, 3, 8, {}};
  raster.samples.reserve(static_cast<std::size_t>(raster.width * raster.height * 3));
  for (int y = 0; y < height; y += kFiner) {
    for (int x = 0; x < width; x += kFiner) {
      std::array<double, 3> sum{};
      for (int v = y; v < y + kFiner; ++v)
        for (int u = x; u < x + kFiner; ++u) {
          const Pixel& pixel =
              pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(u)];
          const double light = std::isinf(pixel.depth) ? 1 : light_at(pixels, width, height, u, v);
          const std::uint32_t colour =
              pixel.point == kNoPoint ? 0xFFFFFF : shown.colours[pixel.point];
          for (std::size_t c = 0; c < 3; ++c)
            sum[c] += light * static_cast<double>(colour >> (16 - 8 * c) & 255U);
        }
      for (const double channel : sum)
        raster.samples.push_back(
            static_cast<std::uint16_t>(std::lround(channel / (kFiner * kFiner))));
    }
  }
  return raster;
}

/// For each segment, the place at which its number is written. The candidates are the visible
/// pixels that have the most room around them inside the segment. The place is the candidate that
/// is nearest to the middle of the segment. There is no place if too few pixels of the segment are
/// visible.
std::vector<std::optional<std::array<double, 2>>> middles_of(const Shown& shown,
                                                             const std::vector<Pixel>& pixels,
                                                             int width, int height,
                                                             std::size_t segments) {
  constexpr std::size_t fewest = 80;  // the number of pixels that a legible number needs
  const auto label_at = [&](int x, int y) -> std::uint32_t {
    if (x < 0 || y < 0 || x >= width || y >= height) return 0;
    const std::size_t place =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    const std::uint32_t point = pixels[place].point;
    return point == kNoPoint ? 0 : shown.labels[point];
  };
  const auto for_each_seen = [&](auto&& visit) {
    for (int y = 0; y < height; y += kFiner)
      for (int x = 0; x < width; x += kFiner)
        if (const std::uint32_t label = label_at(x, y); label != 0) visit(label - 1, x, y);
  };
  struct Seen {
    std::size_t count = 0;
    double x = 0, y = 0;  // sums
    int room = -1;
    double away = 0;
    std::array<double, 2> place{};
  };
  std::vector<Seen> seen(segments);
  for_each_seen([&](std::uint32_t i, int x, int y) {
    ++seen[i].count;
    seen[i].x += x;
    seen[i].y += y;
  });
  /// Counts distances from the shortest on, as long as the pixels at this distance to the left, to
  /// the right, above and below belong to the segment. There are four distances.
  const auto room_at = [&](int x, int y) {
    const std::uint32_t label = label_at(x, y);
    int room = 0;
    for (const int far : {10, 20, 30, 45}) {
      for (const auto& [dx, dy] : {std::pair(-far, 0), {far, 0}, {0, -far}, {0, far}})
        if (label_at(x + dx, y + dy) != label) return room;
      ++room;
    }
    return room;
  };
  for_each_seen([&](std::uint32_t i, int x, int y) {
    Seen& s = seen[i];
    const auto count = static_cast<double>(s.count);
    const int room = room_at(x, y);
    const double away = std::hypot(x - s.x / count, y - s.y / count);
    if (room < s.room || (room == s.room && away >= s.away)) return;
    s.room = room;
    s.away = away;
    s.place = {static_cast<double>(x) / kFiner, static_cast<double>(y) / kFiner};
  });
  std::vector<std::optional<std::array<double, 2>>> middles(segments);
  for (std::size_t i = 0; i < segments; ++i)
    if (seen[i].count >= fewest) middles[i] = seen[i].place;
  return middles;
}

}  // namespace

std::uint32_t colour_in_picture(std::optional<std::uint32_t> colour) {
  return colour ? shaded(*colour, kUsual) : light_grey(kUsual);
}

CloudPicture cloud_picture(const Cloud* cloud, const SceneTree& scene,
                           std::span<const std::uint32_t> labels,
                           std::span<const std::uint32_t> colours, const ViewTurn& turn,
                           const RunContext& context) {
  constexpr std::size_t a_point = sizeof(Vector3d) + 5 * sizeof(std::uint32_t);
  constexpr auto side = static_cast<std::size_t>(kSide) * kFiner;
  const MemoryClaim claim(context.memory, labels.size() * a_point + side * side * sizeof(Pixel));
  const Shown points = shown(cloud, scene, labels, colours);
  const Camera camera(points, scene, turn);
  const std::vector<Pixel> pixels = draw(points, camera, Spacing(scene));
  CloudPicture picture;
  picture.raster = averaged(points, pixels, camera.width(), camera.height());
  picture.points.assign(colours.size() + 1, 0);
  for (const std::uint32_t label : points.labels) ++picture.points[label];
  picture.middles = middles_of(points, pixels, camera.width(), camera.height(), colours.size());
  return picture;
}

}  // namespace ph::segment
