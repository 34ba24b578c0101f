// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "ph/segment.hpp"

namespace ph::segment::test {

/// An upright wall on a full circle or on an arc: a bowl, a cup, a bent sheet. Angles are in
/// degrees. The direction of 90 degrees points away from the sensor.
struct Vessel {
  double x = 0, y = 0, radius = 0.08, height = 0.06;
  double from = 0, to = 360;
  bool has_lid = false;  ///< true for a lid, or for a full vessel
};

/// What a ray may hit.
enum class Met { nothing, table, outside, inside, bottom, lid };

/// Vessels without a bottom on a table at z = 0, seen from a distance of one metre at an angle of
/// 45 degrees. The part of the table that is visible through an opening looks like a thin bottom.
class VesselScene {
 public:
  /// @param depth how far below the table the bottoms appear, as shiny bottoms do.
  explicit VesselScene(std::vector<Vessel> vessels, double depth = 0)
      : vessels_(std::move(vessels)), depth_(depth) {
    for (int v = 0; v < 240; ++v)
      for (int u = 0; u < 320; ++u) cast((u + 0.5 - 160) / 260, (v + 0.5 - 120) / 260);
  }

  explicit VesselScene(const Vessel& vessel, double depth = 0)
      : VesselScene(std::vector{vessel}, depth) {}

  const std::vector<float>& xyz() const { return xyz_; }
  Vec3 eye() const { return {0, -kHalf, kHalf}; }
  CloudView cloud() const { return {xyz_, eye()}; }
  const std::vector<Met>& met() const { return met_; }
  std::size_t count(Met met) const {
    return static_cast<std::size_t>(std::ranges::count(met_, met));
  }
  void add(double x, double y, double z, Met met) {
    for (const double c : {x, y, z}) xyz_.push_back(static_cast<float>(c));
    met_.push_back(met);
  }

 private:
  static constexpr double kHalf = std::numbers::sqrt2 / 2;
  struct Hit {
    double t = kInfinity;
    Met met = Met::nothing;
  };

  void cast(double px, double py) {
    const Vec3 ray{px, kHalf - kHalf * py, -kHalf - kHalf * py};
    const auto at = [&](double t) -> Vec3 {
      return {t * ray[0], t * ray[1] - kHalf, t * ray[2] + kHalf};
    };
    const double table = kHalf / -ray[2];
    Hit nearest{table, Met::table};
    const auto is_over = [](const Vessel& v, const Vec3& p) {
      return std::hypot(p[0] - v.x, p[1] - v.y) < v.radius;
    };
    for (const Vessel& v : vessels_) {
      if (is_over(v, at(table))) nearest = {table + depth_ / -ray[2], Met::bottom};
    }
    const auto take = [&](double t, Met met) {
      if (t > 0 && t < nearest.t) nearest = {t, met};
    };
    for (const Vessel& v : vessels_) {
      const double lid = (v.height - kHalf) / ray[2];
      if (v.has_lid && is_over(v, at(lid))) take(lid, Met::lid);
      const double ox = -v.x, oy = -kHalf - v.y;
      const double a = ray[0] * ray[0] + ray[1] * ray[1], b = ox * ray[0] + oy * ray[1];
      const double root = b * b - a * (ox * ox + oy * oy - v.radius * v.radius);
      if (root < 0) continue;
      for (const double sign : {-1.0, 1.0}) {
        const double t = (-b + sign * std::sqrt(root)) / a;
        if (is_wall(v, at(t))) take(t, sign < 0 ? Met::outside : Met::inside);
      }
    }
    const Vec3 p = at(nearest.t);
    if (std::abs(p[0]) > 0.6 || std::abs(p[1]) > 0.5) return;
    add(p[0], p[1], p[2], nearest.met);
  }
  static bool is_wall(const Vessel& v, const Vec3& p) {
    if (p[2] < 0 || p[2] > v.height) return false;
    const double angle = std::atan2(p[1] - v.y, p[0] - v.x) * 180 / std::numbers::pi;
    for (const double turn : {-360.0, 0.0, 360.0})
      if (angle + turn >= v.from && angle + turn <= v.to) return true;
    return false;
  }

  std::vector<Vessel> vessels_;
  double depth_;
  std::vector<float> xyz_;
  std::vector<Met> met_;
};

}  // namespace ph::segment::test
