// SPDX-License-Identifier: MIT
// Requests that a device cannot fulfil are refused. The other requests are tested in
// gpu/gpu_forest_tests.cpp.
#include "ph/persistence.hpp"
#include "tests/support/expect_error.hpp"

namespace ph::test {
namespace {

const Points kSquare{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
const RipsOptions kForest{.device = Device::gpu};

TEST(Device, DoesComponentsOfEuclideanPointsAlone) {
  const auto message = [](const std::string& found) {
    return "device gpu: found " + found +
           ", expected components (H0) of points with Euclidean distances";
  };
  const auto refused = [&](const std::string& found, const auto& data, const RipsOptions& options) {
    expect_error(ErrorKind::usage, message(found), [&] { Rips(data, options); });
  };
  const auto refused_task = [&](const RipsOptions& options, const Options& task) {
    expect_error(ErrorKind::usage, message("a task for the CPU only"),
                 [&] { plan(Rips(kSquare, options), task); });
    expect_error(ErrorKind::usage, message("a task for the CPU only"),
                 [&] { persistence(Rips(kSquare, options), task); });
  };
  refused_task(kForest, {});
  refused_task(kForest, {.engine = Engine::beta_skeleton});
  refused_task(kForest, {.max_dim = 0, .engine = Engine::standard});
  refused_task({.approximation = 0.5, .device = Device::gpu}, {.max_dim = 0});
  RipsOptions options = kForest;
  options.distance = PointDistance::manhattan;
  refused("a distance that is not Euclidean", kSquare, options);
  options = kForest;
  const std::vector<double> births(4, 0.5);
  options.births = births;
  refused("births of vertices", kSquare, options);
  refused("distances", DistanceMatrix(2, {1}), kForest);
  refused("a sparse matrix of distances", SparseDistances(2, {}), kForest);
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

#ifndef PH_WITH_CUDA  // with CUDA, the driver reports what is missing
TEST(Device, IsSaidToBeMissing) {
  const Options task{.max_dim = 0};
  expect_error(ErrorKind::not_built_in, "device gpu: not built in: it needs CUDA 12 or later",
               [&] { persistence(Rips(kSquare, kForest), task); });
  expect_error(ErrorKind::not_built_in, "-DPH_WITH_CUDA=ON",
               [&] { persistence(Rips(Points(), kForest), task); });
  expect_error(ErrorKind::not_built_in, "-DPH_WITH_CUDA=ON",
               [&] { Rips(kSquare, kForest).graph(RipsForm::forest); });
}
#endif

}  // namespace
}  // namespace ph::test
