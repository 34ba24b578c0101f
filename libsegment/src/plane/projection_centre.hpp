// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include "ph/segment.hpp"

namespace ph::segment {

/// Where the rays of the pixels of an organised cloud meet, if this is not the cloud's viewpoint:
/// then the points are not in the sensor's frame, or the viewpoint is wrong. Empty if they meet at
/// the viewpoint (to a tenth of the range), or if the place cannot be told: the cloud is
/// unorganised, all of it is one plane (a picture of a plane is the same from anywhere), the rays
/// are parallel, or no pinhole camera took the picture.
///
/// The projection of points to pixels is a matrix of 3 x 4, found by the direct linear transform
/// (Hartley & Zisserman 2004, chapter 7); its null vector is the centre. The noise of depth does
/// not matter, because it moves points along their rays. Least squares comes first, and, where
/// outliers spoil it, the least median of squares (Rousseeuw 1984). Looks at some thousands of
/// points; deterministic.
std::optional<Vec3> centre_elsewhere(const CloudView& cloud);

}  // namespace ph::segment
