// SPDX-License-Identifier: MIT
// This file computes Euler and Betti curves as step functions, and Euler curves of images.
#include "ph/euler_curve.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/data/diagrams.hpp"
#include "python/src/recipes.hpp"

namespace ph::python {
namespace {

/// The points at which a curve changes, and its values from these points on.
using Steps = std::pair<Block, Block>;

Steps steps_of(StepFunction&& curve) {
  return {Block::of(std::move(curve.at)), Block::of(std::move(curve.value))};
}

/// @param dims the dimension of each bar. If it is not given, all bars have dimension 0, and the
/// curve shows Betti numbers.
Steps curve_of_bars(const py::buffer& rows, const std::optional<py::buffer>& dims,
                    const RunOptions& options) {
  std::vector<Bar> bars = bars_of(rows);
  if (dims) {
    const std::vector<std::int64_t> given = vector_of<std::int64_t>(*dims);
    for (std::size_t i = 0; i < bars.size(); ++i) bars[i].dim = static_cast<int>(given.at(i));
  }
  constexpr std::size_t few = 100'000;
  return steps_of(
      run(options, bars.size() < few, [&](const RunContext&) { return euler_curve(bars); }));
}

const Cubical& image_in(const Built& built) { return std::get<Cubical>(built.complex); }

Steps curve_of_image(const Recipe& recipe, const RunOptions& options) {
  return steps_of(run(options, recipe.is_short({}), [&](const RunContext& context) {
    const Built built = recipe.build(context);
    return euler_curve(image_in(built), context);
  }));
}

Block values_of_image(const Recipe& recipe, std::pair<double, double> ends, std::size_t points,
                      const RunOptions& options) {
  return Block::of(run(options, recipe.is_short({}), [&](const RunContext& context) {
    const Built built = recipe.build(context);
    std::vector<double> values(points);
    euler_curve(image_in(built), {ends.first, ends.second, points}, values, context);
    return values;
  }));
}

}  // namespace

void bind_euler_curves(py::module_& m) {
  m.def("curve_of_bars", &curve_of_bars, py::arg("rows"), py::arg("dims"), py::arg("run"));
  m.def("curve_of_image", &curve_of_image, py::arg("recipe"), py::arg("run"));
  m.def("values_of_image", &values_of_image, py::arg("recipe"), py::arg("ends"), py::arg("points"),
        py::arg("run"));
}

}  // namespace ph::python
