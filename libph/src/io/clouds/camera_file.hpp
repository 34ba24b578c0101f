// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <span>
#include <string>

#include "ph/detail/io/camera.hpp"

namespace ph::detail {

/// The largest number of pixels along one axis of an image.
constexpr Index kMostPixels = 1 << 20;

/// Advice to give the numbers of a camera without a file.
std::string way_to_intrinsics();

/// The parameters in a camera matrix, given row by row.
/// @param fail throws an error for a matrix that is not one of a camera.
Intrinsics intrinsics_of(std::span<const double, 9> matrix,
                         const std::function<void(const Fault&)>& fail);

/// Reads JSON: Open3D (intrinsic_matrix), RealSense (fx, fy, ppx, ppy) or BOP (fx, fy, cx, cy; or
/// cam_K). These members may be in objects with names, for example one per picture. All such
/// objects must then be equal.
Camera read_json_camera(const Input& input);
/// Reads a camera matrix as text: 9 numbers, or the 16 numbers of a matrix of 4 x 4. The camera
/// fits images of any size.
Camera read_matrix_camera(const Input& input);

}  // namespace ph::detail
