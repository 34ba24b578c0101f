// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "ph/detail/io/reader.hpp"
#include "ph/filtration.hpp"

namespace ph {

/// A pinhole camera, in pixels.
struct Intrinsics {
  double fx = 0, fy = 0;  ///< focal lengths
  double cx = 0, cy = 0;  ///< principal point; the centre of pixel (0, 0) is (0, 0)
};

/// How a lens bends the ray (x, y, 1) on its way to a pixel, in the models of OpenCV and ROS.
struct Lens {
  enum class Model {
    none,
    polynomial,   ///< k1 k2 p1 p2 k3 k4 k5 k6; ROS calls it plumb_bob (the first five) or
                  ///< rational_polynomial
    equidistant,  ///< k1 k2 k3 k4 of fisheye lenses (Kannala & Brandt 2006)
  };
  Model model = Model::none;
  std::array<double, 8> coefficients{};  ///< in the order given in Model; unused ones are 0

  /// The place where the ray (x, y, 1) meets the image, in focal lengths from the principal point.
  std::array<double, 2> bent(double x, double y) const;
  /// A limit for the distance of rays (x, y, 1) from the axis. Distances in the image fall beyond a
  /// first fold of a polynomial, and rise again beyond a second fold; the limit lies midway between
  /// the two. Infinity if there is no second fold.
  double reach() const;
  /// The inverse of `bent`, by Newton's method: x and y of the ray that meets the image there, or
  /// nothing if there is none in the part of the image where the model is one to one.
  /// @param reach the reach of this lens.
  std::optional<std::array<double, 2>> straightened(double x, double y, double reach) const;
};

/// A camera as its calibration describes it.
struct Camera {
  Intrinsics intrinsics;
  Index width = 0, height = 0;  ///< size of its images in pixels; 0 if any size is allowed
  Lens lens = {};
  /// True if the driver crops images of another shape at the sides: they show the same height but a
  /// different width. Only presets set this member.
  bool crops_sides = false;
  /// Depth units per metre in depth images of whole numbers; 0 if not known.
  double depth_scale = 0;

  /// The same camera for images of another size and the same shape, scaled. With `crops_sides`, the
  /// shape may differ.
  /// @throws Error (usage), which names both sizes, if the shape differs but may not.
  Camera scaled_to(Index new_width, Index new_height) const;
};

/// Reads a calibration: camera_info YAML of ROS 1 and 2 (of camera_calibration or `ros2 topic
/// echo`), YAML of OpenCV or with fx, fy, cx, cy, JSON of Open3D, RealSense or BOP, or the 9
/// numbers of a camera matrix. From camera_info it reads K and D, not R and P: the image is assumed
/// to be the raw image unless D is zero. It applies the binning and the region of interest.
/// @throws Error (bad_data) "name:line:column: …" on any other file, or on a lens whose model is
///         unknown.
Camera read_camera(const Input& input);
Camera read_camera(const std::filesystem::path& path, const RunContext* context = nullptr);

/// A model of camera with its name.
struct CameraPreset {
  std::string_view name;
  Camera camera;            ///< nominal values without lens: each device differs by a few per cent
  std::string_view images;  ///< the depth images that the preset fits; others may differ far more
};
std::span<const CameraPreset> camera_presets();

}  // namespace ph
