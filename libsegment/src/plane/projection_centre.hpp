// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include "ph/segment.hpp"

namespace ph::segment {

/// Where the rays of the pixels of an organised cloud meet, if that is elsewhere than at the
/// cloud's viewpoint: the points are then not in the sensor's frame, or the viewpoint is wrong.
/// Nothing if they meet at the viewpoint (to a tenth of the range), or where it cannot be told: the
/// cloud is not organised, all of it is one plane (a picture of a plane is the same from anywhere),
/// the rays are parallel, or the picture is none of a pinhole camera.
///
/// The projection of points to pixels is a matrix of 3 x 4, found by the direct linear transform
/// (Hartley & Zisserman 2004, chapter 7); its null vector is the centre. Noise of depth does not
/// matter: it moves points along their rays. Least squares first, and where outliers spoil them the
/// least median of squares (Rousseeuw 1984). Looks at some thousands of points; deterministic.
std::optional<Vec3> centre_elsewhere(const CloudView& cloud);

}  // namespace ph::segment
