// SPDX-License-Identifier: MIT
// This file computes vectors of diagrams. Python creates the one-axis arrays to which the vectors
// are written.
#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "ph/vectorise.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/data/diagrams.hpp"

namespace ph::python {
namespace {

using Ends = std::pair<double, double>;
using Pixels = std::tuple<double, double, std::size_t>;

/// An array to write to, which this object keeps alive.
class Out {
 public:
  explicit Out(const py::buffer& array) : info_(array.request(true)) {
    const auto numbers = numbers_of<double>(info_);
    numbers_ = {static_cast<double*>(info_.ptr), numbers.size()};
  }
  std::span<double> numbers() const { return numbers_; }
  std::size_t size() const { return numbers_.size(); }
  Grid grid(const Ends& ends) const { return {ends.first, ends.second, size()}; }

 private:
  py::buffer_info info_;
  std::span<double> numbers_;
};

/// True if this number of steps takes milliseconds at most.
bool is_short(std::size_t steps) { return steps < 1'000'000; }

void put_statistics(const py::buffer& rows, const py::buffer& to, const RunOptions& options) {
  const std::vector<Bar> bars = bars_of(rows);
  const Out out(to);
  run(options, is_short(bars.size()), [&](const RunContext&) {
    statistics(bars, out.numbers());
    return true;
  });
}

std::vector<std::string> names_of_statistics() {
  return {statistics_names().begin(), statistics_names().end()};
}

double entropy_of(const py::buffer& rows, bool is_normalised, const RunOptions& options) {
  const std::vector<Bar> bars = bars_of(rows);
  return run(options, is_short(bars.size()),
             [&](const RunContext&) { return entropy(bars, is_normalised); });
}

void put_lengths(const py::buffer& rows, const py::buffer& to, const RunOptions& options) {
  const std::vector<Bar> bars = bars_of(rows);
  const Out out(to);
  run(options, is_short(bars.size() + out.size()), [&](const RunContext&) {
    longest_lengths(bars, out.numbers());
    return true;
  });
}

/// Writes a curve of a diagram at the values of a grid.
template <class Curve>
void put_curve(const py::buffer& rows, const Ends& ends, const py::buffer& to,
               const RunOptions& options, const Curve& curve) {
  const std::vector<Bar> bars = bars_of(rows);
  const Out out(to);
  run(options, is_short(bars.size() + out.size()), [&](const RunContext&) {
    curve(bars, out.grid(ends), out.numbers());
    return true;
  });
}

void put_betti_curve(const py::buffer& rows, const Ends& ends, const py::buffer& out,
                     const RunOptions& options) {
  put_curve(rows, ends, out, options,
            [](const auto& bars, const Grid& grid, auto to) { betti_curve(bars, grid, to); });
}

void put_life_entropy(const py::buffer& rows, const Ends& ends, const py::buffer& out,
                      const RunOptions& options) {
  put_curve(rows, ends, out, options, [](const auto& bars, const Grid& grid, auto to) {
    life_entropy_curve(bars, grid, to);
  });
}

void put_silhouette(const py::buffer& rows, const Ends& ends, double power, const py::buffer& out,
                    const RunOptions& options) {
  put_curve(rows, ends, out, options, [power](const auto& bars, const Grid& grid, auto to) {
    silhouette(bars, grid, power, to);
  });
}

/// @param to receives layers × points numbers.
void put_landscape(const py::buffer& rows, const Ends& ends, std::size_t layers,
                   const py::buffer& to, const RunOptions& options) {
  const std::vector<Bar> bars = bars_of(rows);
  const Out out(to);
  const Grid grid{ends.first, ends.second, out.size() / layers};
  run(options, is_short(bars.size() * layers + out.size()), [&](const RunContext& context) {
    landscape(bars, grid, layers, out.numbers(), context);
    return true;
  });
}

/// For each layer, returns its critical points and the values there.
std::vector<std::pair<Block, Block>> exact_landscape_of(const py::buffer& rows, std::size_t layers,
                                                        const RunOptions& options) {
  const std::vector<Bar> bars = bars_of(rows);
  std::vector<PiecewiseLinear> found =
      run(options, is_short(bars.size() * std::min(layers, bars.size())),
          [&](const RunContext& context) { return exact_landscape(bars, layers, context); });
  std::vector<std::pair<Block, Block>> blocks;
  for (PiecewiseLinear& layer : found)
    blocks.emplace_back(Block::of(std::move(layer.at)), Block::of(std::move(layer.value)));
  return blocks;
}

PixelRange range_of(const Pixels& pixels) {
  return {std::get<0>(pixels), std::get<1>(pixels), std::get<2>(pixels)};
}

void put_image(const py::buffer& rows, const Pixels& births, const Pixels& lengths, double sigma,
               double power, const py::buffer& to, const RunOptions& options) {
  const std::vector<Bar> bars = bars_of(rows);
  const Out out(to);
  run(options, is_short(bars.size() * out.size()), [&](const RunContext& context) {
    persistence_image(bars, {range_of(births), range_of(lengths)}, sigma, power, out.numbers(),
                      context);
    return true;
  });
}

Ends fitted_range(const std::vector<py::buffer>& diagrams) {
  const Diagrams given(diagrams);
  const Grid grid = fit_grid(given.spans());
  return {grid.lo, grid.hi};
}

Atol::Contrast contrast_of(const std::string& word) {
  return word == "gauss" ? Atol::Contrast::gauss : Atol::Contrast::laplace;
}

/// Returns the centres, as rows birth, death, and their widths.
std::pair<Block, Block> fitted_atol(const std::vector<py::buffer>& diagrams, std::size_t centres,
                                    std::uint64_t seed, int most_rounds,
                                    const RunOptions& options) {
  const Diagrams given(diagrams);
  // The fit does not depend on the contrast.
  const AtolOptions how{centres, Atol::Contrast::laplace, seed, most_rounds};
  Atol fitted = run(options, false, [&](const RunContext& context) {
    return fit_atol(given.spans(), how, context);
  });
  std::vector<double> flat;
  for (const std::array<double, 2>& centre : fitted.centres)
    flat.insert(flat.end(), centre.begin(), centre.end());
  const auto rows = static_cast<py::ssize_t>(fitted.centres.size());
  return {Block::of(std::move(flat), {rows, 2}), Block::of(std::move(fitted.widths))};
}

void put_atol(const py::buffer& rows, const py::buffer& centres, const py::buffer& widths,
              const std::string& contrast, const py::buffer& to, const RunOptions& options) {
  const std::vector<Bar> bars = bars_of(rows);
  Atol fitted;
  fitted.contrast = contrast_of(contrast);
  fitted.widths = vector_of<double>(widths);
  for (const Bar& place : bars_of(centres)) fitted.centres.push_back({place.birth, place.death});
  const Out out(to);
  run(options, is_short(bars.size() * out.size()), [&](const RunContext&) {
    atol_vector(bars, fitted, out.numbers());
    return true;
  });
}

}  // namespace

void bind_vectors(py::module_& m) {
  m.def("statistics", &put_statistics, py::arg("rows"), py::arg("out"), py::arg("run"));
  m.def("statistics_names", &names_of_statistics);
  m.def("entropy", &entropy_of, py::arg("rows"), py::arg("is_normalised"), py::arg("run"));
  m.def("longest_lengths", &put_lengths, py::arg("rows"), py::arg("out"), py::arg("run"));
  m.def("betti_curve", &put_betti_curve, py::arg("rows"), py::arg("ends"), py::arg("out"),
        py::arg("run"));
  m.def("life_entropy_curve", &put_life_entropy, py::arg("rows"), py::arg("ends"), py::arg("out"),
        py::arg("run"));
  m.def("silhouette", &put_silhouette, py::arg("rows"), py::arg("ends"), py::arg("power"),
        py::arg("out"), py::arg("run"));
  m.def("landscape", &put_landscape, py::arg("rows"), py::arg("ends"), py::arg("layers"),
        py::arg("out"), py::arg("run"));
  m.def("exact_landscape", &exact_landscape_of, py::arg("rows"), py::arg("layers"), py::arg("run"));
  m.def("persistence_image", &put_image, py::arg("rows"), py::arg("births"), py::arg("lengths"),
        py::arg("sigma"), py::arg("power"), py::arg("out"), py::arg("run"));
  m.def("fitted_range", &fitted_range, py::arg("diagrams"));
  m.def("fit_atol", &fitted_atol, py::arg("diagrams"), py::arg("centres"), py::arg("seed"),
        py::arg("most_rounds"), py::arg("run"));
  m.def("atol_vector", &put_atol, py::arg("rows"), py::arg("centres"), py::arg("widths"),
        py::arg("contrast"), py::arg("out"), py::arg("run"));
}

}  // namespace ph::python
