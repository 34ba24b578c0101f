// SPDX-License-Identifier: MIT
#pragma once

namespace ph {

/// Bounds for differences of coordinates whose squares neither overflow nor lose digits to
/// underflow.
inline constexpr double kSmallestPlain = 1e-140, kLargestPlain = 1e150;

}  // namespace ph
