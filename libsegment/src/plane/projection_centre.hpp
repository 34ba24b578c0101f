// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include "ph/segment.hpp"

namespace ph::segment {

/// The point at which the rays of the pixels of an organised cloud meet, if it is not the cloud's
/// viewpoint. In this case, either the points are not in the sensor's frame, or the viewpoint is
/// wrong. Empty if the rays meet at the viewpoint (to a tenth of the range). Also empty if the
/// point cannot be determined, which is the case if
/// - the cloud is unorganised;
/// - the rays are parallel;
/// - no pinhole camera took the picture.
///
/// The projection of points to pixels is a 3 x 4 matrix, found by the direct linear transform
/// (Hartley & Zisserman 2004, chapter 7). Its null vector is the centre. The noise of depth does
/// not matter, because it moves points along their rays. The matrix is found by least squares. If
/// outliers spoil this fit, it is found by the least median of squares (Rousseeuw 1984). The
/// function looks at some thousands of points, and is deterministic.
std::optional<Vec3> centre_elsewhere(const CloudView& cloud);

}  // namespace ph::segment
