// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include "ph/segment.hpp"

namespace ph::segment {

/// The point at which the rays of the pixels of an organised cloud meet, if it is not the cloud's
/// viewpoint: then the points are not in the sensor's frame, or the viewpoint is wrong. Empty if
/// the rays meet at the viewpoint (to a tenth of the range). Also empty if the point cannot be
/// determined:
/// - the cloud is unorganised;
/// - all its points lie on one plane (a picture of a plane is the same from anywhere);
/// - the rays are parallel;
/// - no pinhole camera took the picture.
///
/// The projection of points to pixels is a matrix of 3 x 4, found by the direct linear transform
/// (Hartley & Zisserman 2004, chapter 7); its null vector is the centre. The noise of depth does
/// not matter, because it moves points along their rays. The matrix is found by least squares or,
/// if outliers spoil this fit, by the least median of squares (Rousseeuw 1984). Looks at some
/// thousands of points; deterministic.
std::optional<Vec3> centre_elsewhere(const CloudView& cloud);

}  // namespace ph::segment
