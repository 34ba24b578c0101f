// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ph/segment.hpp"

namespace ph::segment {

/// The distance from a plane up to which a point counts as part of it.
struct PlaneMargin {
  double distance;  ///< in metres
  /// The least margin at a range of one metre, in metres. It allows for the noise of depth from
  /// disparity, which grows with the square of the range (Khoshelham & Elberink 2012).
  double noise = 0;

  double operator()(const CloudView& cloud, const float* p) const {
    const double x = p[0] - cloud.viewpoint[0], y = p[1] - cloud.viewpoint[1];
    const double z = p[2] - cloud.viewpoint[2];
    return at(x * x + y * y + z * z);
  }
  double at(double square_of_range) const { return std::max(distance, noise * square_of_range); }
};

/// The result of the search for a plane.
struct PlaneSearch {
  std::optional<Plane> plane;
  std::string note;  ///< the reason why there is no plane; empty if there is one
  /// The standard deviation of the heights of the plane's points at a range of one unit, assuming
  /// that it grows with the square of the range. It is estimated from the points behind the plane,
  /// where there are no objects. It is 0 if these points are too few.
  double noise = 0;
  /// As `noise`, but of the depths along the rays, which meet the plane at a slant.
  double noise_along = 0;
  double range = 0;  ///< the median distance of the plane's points from the viewpoint, in metres
};

inline constexpr std::string_view kTooFewPoints = "no plane: fewer than three points in range";

/// The least area of a table or of a board on which things stand, in square metres. It is twice the
/// area of a large board game.
inline constexpr double kLeastTable = 0.2;

/// The thickest board of a table or a shelf, in metres. Below its top, the edge may be seen.
inline constexpr double kThickestBoard = 0.05;

/// Points nearer to a plane than this number of margins may belong to the plane itself.
inline constexpr double kMarginsOfPlane = 2;

/// Noise puts a point so many standard deviations off its plane at most.
inline constexpr double kDeviations = 4;

/// A plane with a smaller share of the points supports nothing.
inline constexpr double kLeastShareOfSupport = 0.1;

/// Finds the plane with the most points. Uses RANSAC on a sample (Fischler & Bolles 1981, scored as
/// in MSAC, Torr & Zisserman 2000) and least-squares refits. Takes O(points) time. The number of
/// hypotheses is fixed, so the worst case is as fast as the best case. A hash of the coordinates
/// draws the sample. The plane therefore does not depend on the order of the points, on duplicates,
/// or on scaling by a power of two.
/// @param points indices into the cloud, none of them a hole.
/// @param margin half the thickness of the plane. @param guess the plane of a previous frame, which
/// replaces the hypotheses if the share of the points on it is still nearly Plane::share.
PlaneSearch find_plane(const CloudView& cloud, const std::vector<Index>& points,
                       const PlaneMargin& margin, const std::optional<Plane>& guess = {});

struct Sample;
/// Finds the plane with the most points of a sample. @param guess as above.
PlaneSearch find_plane(const Sample& sample, const Vec3& viewpoint,
                       const std::optional<Plane>& guess = {});
/// Finds the plane with the most points among those that are parallel to another plane and face the
/// viewpoint as it does. The refits may turn the plane a little. Empty, without a note, if the
/// viewpoint is in front of no such plane.
PlaneSearch find_parallel(const Plane& like, const Sample& sample, const Vec3& viewpoint);

/// The supporting plane, and other large planes that are not faces of objects.
struct SupportSearch {
  PlaneSearch support;
  std::vector<Plane> others;
};

/// Finds the supporting plane. It is the largest plane, unless nothing is seen behind it. Such a
/// plane may be a wall; of this plane and the next largest ones, the support is then the plane that
/// most things touch from above. There is no support if the surface goes on behind the largest
/// plane, which is then a face of an object. There is also none if this plane is smaller than a
/// table and either nothing stands on it or it is thick for its size, as a curved surface is.
/// @param points indices into the cloud, none of them a hole.
/// @param sample a sample of these points. @param guess as for find_plane.
SupportSearch find_support(const CloudView& cloud, const std::vector<Index>& points,
                           const PlaneMargin& margin, const Sample& sample,
                           const std::optional<Plane>& guess = {});

/// The points in range, divided by a plane.
struct Cleared {
  std::vector<Index> beyond;  ///< on the sensor's side of the plane and beyond the margin
  /// Within the margin, on both sides; these points count as part of the plane.
  std::vector<Index> on;
  std::vector<Index> strip;  ///< the points of `on` on the sensor's side
};

/// Removes the points on the plane or behind it (such as the floor beyond a table's edge, or
/// reflections), because they stand on nothing. All lists are in the order of `points`.
Cleared remove_plane(const CloudView& cloud, const std::vector<Index>& points, const Plane& plane,
                     const PlaneMargin& margin);

/// The share of all points of a cloud, without holes, that are behind a plane and beyond the
/// margin. In a large cloud, the share is computed from a sample of the points.
double share_behind(const CloudView& cloud, const Plane& plane, const PlaneMargin& margin);

/// Points nearer to a wall than this margin may belong to the wall itself.
inline constexpr PlaneMargin kOfWalls{0.02, 0.02};
/// The share of points behind a wall that reflections and flying pixels may cause.
inline constexpr double kMostBehind = 0.01;

/// True if nearly all points of a cloud are on the viewpoint's side of a plane.
bool bounds_the_view(const Plane& plane, const CloudView& cloud);

/// The least cosine of the angle between planes that count as parallel.
inline constexpr double kLeastOfParallel = 0.99;

/// The role of a plane that bounds the view: a wall if it is steep, and a ceiling if it faces the
/// support. Empty for any other plane.
std::optional<Role> role_of_bound(const Plane& plane, const Plane& support, const CloudView& cloud);

/// True if a plane is at more than 60 degrees to the support, as a wall is.
bool is_steep(const Plane& plane, const Plane& support);

/// The cosine of the angle between two planes, below zero if they face each other.
double cosine_between(const Plane& a, const Plane& b);

}  // namespace ph::segment
