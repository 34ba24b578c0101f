// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ph/detail/io/camera.hpp"

namespace ph::detail {

/// The numbers of a camera under the names that Open3D, RealSense's SDK and the BOP data sets use,
/// in JSON or YAML.
struct CameraMembers {
  struct Place {
    std::size_t line = 0, column = 0;
  };
  std::optional<Intrinsics> matrix;
  bool needs_size = false;  ///< a matrix of Open3D, which belongs to images of one size
  std::optional<double> fx, fy, cx, cy;
  bool is_bop = false;  ///< the members are named as in BOP
  Index width = 0, height = 0;
  std::optional<double> depth_scale;
  Place scale_place = {};
  std::string model;
  std::vector<double> coefficients;
  Place lens_place = {};

  /// Takes the size and the scale that stand beside this camera, unless it has its own.
  void complete(const CameraMembers& around);
  /// True if any of the numbers are there that make a camera.
  bool has_any() const { return matrix || fx || fy || cx || cy; }
  /// Refuses a scale that no program writes. Precondition: depth_scale has a value.
  [[noreturn]] void refuse_scale(const Input& input) const;
};

/// The camera with these numbers. @throws Error (bad_data) if numbers are missing or impossible.
Camera camera_of(const CameraMembers& members, const Input& input);

/// The camera in a file whose cameras have names: the numbers of pictures, or color and depth.
/// @throws Error (bad_data) unless all cameras are equal. Precondition: there is at least one.
Camera camera_of(const std::vector<std::pair<std::string, CameraMembers>>& named,
                 const Input& input);

}  // namespace ph::detail
