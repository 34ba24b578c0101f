// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ph/label_tracker.hpp"

namespace ph::segment {

std::optional<CameraMotion> camera_motion(const SceneTree& before, const SceneTree& after) {
  // The turn is in degrees, and the shift is in metres at a range of one metre.
  constexpr double least_turn = 0.5, least_shift = 0.005;
  if (!before.plane || !after.plane) return std::nullopt;
  const auto height = [](const SceneTree& scene) {
    const auto& [x, y, z] = scene.viewpoint;
    return scene.plane->signed_distance(x, y, z);
  };
  const Vec3 &a = before.plane->normal, &b = after.plane->normal;
  // The angle is computed from the chord, because the cosine of a small angle is rounded to 1.
  const double chord = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  const double turn = 2 * std::asin(std::min(1.0, chord / 2)) * 180 / std::numbers::pi;
  const double shift = height(after) - height(before);
  const double square = std::max(1.0, height(before) * height(before));
  if (turn <= least_turn && std::abs(shift) <= least_shift * square) return std::nullopt;
  return CameraMotion{turn, shift};
}

}  // namespace ph::segment
