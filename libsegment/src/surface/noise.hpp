// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "ph/segment.hpp"
#include "surface/concavity.hpp"

namespace ph::segment {

/// How concave a flat surface looks: what the noise of the sensor makes of it, by range.
class ConcavityNoise {
 public:
  ConcavityNoise() = default;
  /// @param ranges from the viewpoint, of places where the surface is flat. @param values the
  /// concavity that was found there.
  ConcavityNoise(const std::vector<double>& ranges, const std::vector<double>& values);

  /// At a range; a typical value if nothing is known. Never so small that details of an object
  /// count as many times the noise, nor so large that no seam stands out.
  double at(double range) const;
  /// What was measured: nearest first.
  const std::vector<NoiseAt>& measured() const { return measured_; }

 private:
  std::vector<NoiseAt> measured_;
};

}  // namespace ph::segment
