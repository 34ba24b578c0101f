// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "libsegment/src/surface/concavity.hpp"
#include "ph/segment.hpp"

namespace ph::segment {

/// The concavity that the sensor's noise causes on a flat surface, as a function of the range.
class ConcavityNoise {
 public:
  ConcavityNoise() = default;
  /// @param ranges distances from the viewpoint to places where the surface is flat.
  /// @param values the concavity measured at each of these places.
  ConcavityNoise(const std::vector<double>& ranges, const std::vector<double>& values);

  /// The noise at a range, or a typical value if nothing was measured. It is never zero, even for a
  /// point at the viewpoint.
  double at(double range) const;
  /// The measured values, nearest first.
  const std::vector<NoiseAt>& measured() const { return measured_; }

 private:
  std::vector<NoiseAt> measured_;
};

}  // namespace ph::segment
