// SPDX-License-Identifier: MIT
#include "ph/detail/io/camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ph/barcode.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

/// The image point (u, v) of a ray (x, y), and the derivative d(u, v) / d(x, y).
struct Bent {
  double u, v, ux, uy, vx, vy;
};

Bent bent_polynomial(const std::array<double, 8>& c, double x, double y) {
  const auto [k1, k2, p1, p2, k3, k4, k5, k6] = c;  // mutant: camera-tangential
  const double r = x * x + y * y;                   // the squared radius
  const double above = 1 + r * (k1 + r * (k2 + r * k3)), below = 1 + r * (k4 + r * (k5 + r * k6));
  const double radial = above / below;
  // The derivative d radial / d r.
  const double slope =
      (k1 + r * (2 * k2 + r * 3 * k3) - radial * (k4 + r * (2 * k5 + r * 3 * k6))) / below;
  return {x * radial + 2 * p1 * x * y + p2 * (r + 2 * x * x),
          y * radial + p1 * (r + 2 * y * y) + 2 * p2 * x * y,
          radial + 2 * x * x * slope + 2 * p1 * y + 6 * p2 * x,
          2 * x * y * slope + 2 * p1 * x + 2 * p2 * y,
          2 * x * y * slope + 2 * p1 * x + 2 * p2 * y,
          radial + 2 * y * y * slope + 6 * p1 * y + 2 * p2 * x};
}

/// The angle between a ray and the optical axis after the distortion of the lens, and the
/// derivative of this angle with respect to `angle`.
std::array<double, 2> shown_angle(const std::array<double, 8>& k, double angle) {
  const double s = angle * angle;
  return {angle * (1 + s * (k[0] + s * (k[1] + s * (k[2] + s * k[3])))),
          1 + s * (3 * k[0] + s * (5 * k[1] + s * (7 * k[2] + s * 9 * k[3])))};
}

constexpr int kSteps = 50;  // Newton's method needs about five steps
constexpr double kExact = 1e-12;

}  // namespace

std::array<double, 2> Lens::bent(double x, double y) const {
  if (model == Model::none) return {x, y};
  if (model == Model::polynomial) {
    const Bent b = bent_polynomial(coefficients, x, y);
    return {b.u, b.v};
  }
  const double radius = std::hypot(x, y);
  if (radius == 0) return {0, 0};
  const double factor = shown_angle(coefficients, std::atan(radius))[0] / radius;
  return {factor * x, factor * y};
}

double Lens::reach() const {
  if (model != Model::polynomial) return kInfinity;
  Lens axial = *this;  // the tangential terms hardly change where the image folds over
  axial.coefficients[2] = axial.coefficients[3] = 0;
  constexpr int angles = 4096;
  double fold = kInfinity;
  for (int i = 1; i < angles; ++i) {
    const double radius = std::tan(std::numbers::pi / 2 * i / angles);
    const bool rises = bent_polynomial(axial.coefficients, radius, 0).ux > 0;
    if (!rises && fold == kInfinity) fold = radius;
    // Beyond a second fold, distances from the centre of the image increase again. The limit is
    // therefore set midway between the two folds.
    if (rises && fold != kInfinity) return (fold + radius) / 2;
  }
  return kInfinity;
}

std::optional<std::array<double, 2>> Lens::straightened(double u, double v, double reach) const {
  if (model == Model::none) return std::array{u, v};
  if (model == Model::equidistant) {
    const double shown = std::hypot(u, v);
    if (shown == 0) return std::array{0.0, 0.0};
    double angle = shown;
    for (int i = 0; i < kSteps; ++i) {
      const auto [value, slope] = shown_angle(coefficients, angle);
      if (!(slope > 0)) return std::nullopt;
      const double step = (value - shown) / slope;
      angle -= step;
      if (std::abs(step) > kExact) continue;
      if (!(angle > 0 && angle < std::numbers::pi / 2)) return std::nullopt;
      const double factor = std::tan(angle) / shown;
      return std::array{factor * u, factor * v};
    }
    return std::nullopt;
  }
  double x = u, y = v;
  for (int i = 0; i < kSteps; ++i) {
    const Bent b = bent_polynomial(coefficients, x, y);
    const double determinant = b.ux * b.vy - b.uy * b.vx;
    // mutant: camera-edge
    if (!(determinant > 0)) return std::nullopt;  // the image folds over here
    const double du = b.u - u, dv = b.v - v;
    const double dx = (b.vy * du - b.uy * dv) / determinant;
    const double dy = (b.ux * dv - b.vx * du) / determinant;
    x -= dx;
    y -= dy;
    if (std::abs(dx) + std::abs(dy) > kExact) continue;
    if (!(std::hypot(x, y) < reach)) return std::nullopt;
    return std::array{x, y};
  }
  return std::nullopt;
}

Camera Camera::scaled_to(Index new_width, Index new_height) const {
  if (width == 0 || (width == new_width && height == new_height)) return *this;
  const bool same_shape = width * new_height == height * new_width;
  if (!same_shape && !crops_sides) {
    throw Error(ErrorKind::usage,
                fmt::format("{}: found an image of {} x {} pixels, expected {} x {} as in its "
                            "calibration, or the same aspect ratio",
                            mark_place("camera"), new_width, new_height, width, height));
  }
  Camera result = *this;
  result.width = new_width;
  result.height = new_height;
  const double factor = static_cast<double>(new_height) / static_cast<double>(height);
  Intrinsics& k = result.intrinsics;
  k.fx *= factor;
  k.fy *= factor;
  // The centres of pixels are at integers. The edge of the image is half a pixel before the first
  // centre.
  // mutant: camera-centre
  k.cx = same_shape ? (k.cx + 0.5) * factor - 0.5 : static_cast<double>(new_width - 1) / 2;
  k.cy = (k.cy + 0.5) * factor - 0.5;
  return result;
}

std::span<const CameraPreset> camera_presets() {
  // These numbers are for depth registered to the colour camera, as in OpenNI's drivers and many
  // data sets.
  static constexpr Camera primesense{{525, 525, 319.5, 239.5}, 640, 480};
  // These numbers are for the depth camera of the second Kinect. They are the default of
  // libfreenect2 and Open3D.
  static constexpr Camera kinect_v2{{365.456, 365.456, 254.878, 205.395}, 512, 424};
  // These numbers are for depth aligned to the colour camera, whose field of view is 69 x 42
  // degrees at 16:9 according to the data sheet.
  static constexpr Camera realsense{{924, 924, 639.5, 359.5}, 1280, 720, {}, true};
  static constexpr std::string_view registered = "depth registered to the colour camera";
  static constexpr std::array<CameraPreset, 5> presets{
      {{"kinect-v1", primesense, registered},
       {"xtion", primesense, registered},
       {"kinect-v2", kinect_v2, "images of the depth camera itself"},
       {"realsense-d415", realsense, registered},
       {"realsense-d435", realsense, registered}}};
  return presets;
}

}  // namespace ph
