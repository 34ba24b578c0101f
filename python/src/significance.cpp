// SPDX-License-Identifier: MIT
// This file tests which bars are unlikely to be random, and whether groups of barcodes differ.
#include "ph/significance.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"

namespace ph::python {
namespace {

/// Returns the p-values of rows birth, death, and the p-values that are corrected for the number of
/// rows tested.
py::tuple p_values(const py::buffer& bars, const std::string& filtration) {
  const py::buffer_info info = bars.request();
  const PointsView rows = points_of(info);
  std::vector<Bar> diagram;
  diagram.reserve(static_cast<std::size_t>(rows.rows()));
  for (Index i = 0; i < rows.rows(); ++i) diagram.push_back({1, rows(i, 0), rows(i, 1)});
  BarPValues found = universal_p_values(
      diagram, filtration == "rips" ? DistanceFiltration::rips : DistanceFiltration::cech);
  return py::make_tuple(Block::of(std::move(found.p)), Block::of(std::move(found.corrected)));
}

double radius(const py::buffer& points, double alpha, std::size_t subsamples, std::size_t size,
              std::uint64_t seed, const RunOptions& options) {
  const py::buffer_info info = points.request();
  const PointsView rows = points_of(info);
  return run(options, false, [&](const RunContext& context) {
    return confidence_radius(rows, {alpha, subsamples, size, seed}, context);
  });
}

/// Returns the mean, and half the width of the band. @param functions an array of one axis, row
/// after row.
py::tuple band(const py::buffer& functions, std::size_t samples, double alpha,
               std::size_t repetitions, std::uint64_t seed, const RunOptions& options) {
  const py::buffer_info info = functions.request();
  const std::span<const double> numbers = numbers_of<double>(info);
  ConfidenceBand found = run(options, false, [&](const RunContext& context) {
    return multiplier_bootstrap(numbers, samples, {alpha, repetitions, seed}, context);
  });
  return py::make_tuple(Block::of(std::move(found.mean)), found.half_width);
}

/// Returns p and the loss. @param distances a square matrix. @param groups the group of each row of
/// the matrix.
py::tuple permutation(const py::buffer& distances, const py::buffer& groups, std::size_t shuffles,
                      double power, std::uint64_t seed, const RunOptions& options) {
  const py::buffer_info info = distances.request(), labels = groups.request();
  const PointsView matrix = points_of(info);
  const std::span<const std::int64_t> numbers = numbers_of<std::int64_t>(labels);
  const PermutationTest found = run(options, false, [&](const RunContext& context) {
    std::vector<double> lower;
    for (Index i = 0; i < matrix.rows(); ++i)
      for (Index j = 0; j < i; ++j) lower.push_back(matrix(i, j));
    return permutation_test({matrix.rows(), std::move(lower)}, numbers, {shuffles, power, seed},
                            context);
  });
  return py::make_tuple(found.p, found.loss);
}

}  // namespace

void bind_significance(py::module_& m) {
  m.def("p_values", &p_values, py::arg("bars"), py::arg("filtration"));
  m.def("confidence_radius", &radius, py::arg("points"), py::arg("alpha"), py::arg("subsamples"),
        py::arg("size"), py::arg("seed"), py::arg("run"));
  m.def("confidence_band", &band, py::arg("functions"), py::arg("samples"), py::arg("alpha"),
        py::arg("repetitions"), py::arg("seed"), py::arg("run"));
  m.def("permutation_test", &permutation, py::arg("distances"), py::arg("groups"),
        py::arg("shuffles"), py::arg("power"), py::arg("seed"), py::arg("run"));
}

}  // namespace ph::python
