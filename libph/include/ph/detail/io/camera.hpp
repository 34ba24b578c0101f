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

/// How a lens bends the ray (x, y, 1) on its way to the pixel: the models of OpenCV and ROS.
struct Lens {
  enum class Model {
    none,
    polynomial,   ///< k1 k2 p1 p2 k3 k4 k5 k6: ROS calls it plumb_bob (the first five) or
                  ///< rational_polynomial
    equidistant,  ///< k1 k2 k3 k4, of fisheye lenses (Kannala & Brandt 2006)
  };
  Model model = Model::none;
  std::array<double, 8> coefficients{};  ///< as above; the others are 0

  /// Where the ray (x, y, 1) meets the image, in focal lengths from the principal point.
  std::array<double, 2> bent(double x, double y) const;
  /// Up to which distance from the axis rays (x, y, 1) meet the image one to one: behind it a
  /// polynomial that has turned back may rise again. Infinity where it does not.
  double reach() const;
  /// The inverse of `bent`, by Newton's method: x and y of the ray that meets the image there;
  /// nothing if there is none in the part of the image where the model is one to one.
  /// @param reach that of this lens.
  std::optional<std::array<double, 2>> straightened(double x, double y, double reach) const;
};

/// A camera as a calibration describes it.
struct Camera {
  Intrinsics intrinsics;
  Index width = 0, height = 0;  ///< of the images that they are of, pixels; 0: any
  Lens lens = {};
  /// Whether images of another shape show the same height, and less or more at the sides: the
  /// driver crops them. Of a preset only.
  bool crops_sides = false;
  double depth_scale = 0;  ///< depth units a metre of its images of whole numbers; 0: not known

  /// The same camera with images of another size: of the same shape, scaled.
  /// @throws Error (usage) saying both sizes if the shape is another one.
  Camera scaled_to(Index new_width, Index new_height) const;
};

/// A calibration: the camera_info YAML of ROS 1 and 2 (a file of camera_calibration, or what
/// `ros2 topic echo` prints), that of OpenCV, or Open3D's intrinsic JSON. Of camera_info K and D
/// are read, not R and P: the image is the raw one unless D is zero. Binning and region of interest
/// are applied.
/// @throws Error (bad_data) "name:line:column: …" on what is not such a file, or on a lens whose
///         model is unknown.
Camera read_camera(const Input& input);
Camera read_camera(const std::filesystem::path& path, const RunContext* context = nullptr);

/// A camera by its name.
struct CameraPreset {
  std::string_view name;
  Camera camera;            ///< nominal: each device differs by some per cent; no lens
  std::string_view images;  ///< which depth images it is for; others may differ by far more
};
std::span<const CameraPreset> camera_presets();

}  // namespace ph
