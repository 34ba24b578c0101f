// SPDX-License-Identifier: MIT
// What a device is asked for and cannot do is refused; what it does: gpu/gpu_forest_tests.cpp.
#include "ph/barcode.hpp"
#include "ph/rips.hpp"
#include "support/expect_error.hpp"

namespace ph::test {
namespace {

const Points kSquare{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
constexpr RipsOptions kForest{.only_components = true, .device = Device::gpu};

TEST(Device, DoesComponentsOfEuclideanPointsAlone) {
  const std::string can = "device gpu: computes components (H0) of points with Euclidean distances";
  const auto refused = [&](const std::string& found, const auto& data, const RipsOptions& options) {
    expect_error(ErrorKind::usage, can + ", found " + found, [&] { Rips(data, options); });
  };
  refused("more than components", kSquare, {.device = Device::gpu});
  refused("more than components", kSquare, {.only_points = true, .device = Device::gpu});
  refused("more than components", kSquare, {.approximation = 0.5, .device = Device::gpu});
  RipsOptions options = kForest;
  options.distance = PointDistance::manhattan;
  refused("another distance", kSquare, options);
  options = kForest;
  const std::vector<double> births(4, 0.5);
  options.births = births;
  refused("births of vertices", kSquare, options);
  refused("distances", DistanceMatrix(2, {1}), kForest);
  refused("some distances", SparseDistances(2, {}), kForest);
  refused("distances", PointMetric(kSquare), kForest);
}

TEST(Device, ArgumentsAreCheckedFirst) {
  RipsOptions options = kForest;
  options.threshold = -1;
  expect_error(ErrorKind::usage, "threshold", [&] { Rips(kSquare, options); });
  expect_error(ErrorKind::bad_data, "point 0, coordinate 0", [&] {
    Rips(Points{{kInfinity}, {0}}, kForest);
  });
}

#ifndef PH_WITH_CUDA  // else the driver says what is missing
TEST(Device, IsSaidToBeMissing) {
  expect_error(ErrorKind::not_built_in, "device gpu: not built in: it needs CUDA 12 or later",
               [] { Rips(kSquare, kForest); });
  expect_error(ErrorKind::not_built_in, "-DPH_WITH_CUDA=ON", [] { Rips(Points(), kForest); });
}
#endif

}  // namespace
}  // namespace ph::test
