// SPDX-License-Identifier: MIT
// Replaces the files that CUDA compiles, in builds without CUDA.
#include "libph/src/gpu/gpu_forest.hpp"
#include "ph/error.hpp"

namespace ph::gpu {

FlagEdges spanning_forest(const PointMetric&, double, const RunContext&) {
  throw Error(ErrorKind::not_built_in,
              "device gpu: not built in: it needs CUDA 12 or later and a libph that was "
              "configured with -DPH_WITH_CUDA=ON");
}

}  // namespace ph::gpu
