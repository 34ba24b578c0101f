// SPDX-License-Identifier: MIT
#include "python/src/results/bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "ph/error.hpp"
#include "ph/io/plot.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/results/bars_state.hpp"
#include "python/src/results/state.hpp"

namespace ph::python {
namespace {

std::size_t place_in(const Bars& bars, std::int64_t i) {
  if (i < 0 || static_cast<std::size_t>(i) >= bars.barcode.size())
    throw Error(ErrorKind::usage, fmt::format("bar: found {}, expected 0 to {}", i,
                                              static_cast<std::int64_t>(bars.barcode.size()) - 1));
  return static_cast<std::size_t>(i);
}

/// The cells of the bars of one dimension, one per row. The row is -1 for a bar without a cell.
/// @param cell_of returns the numbers of the cell of the bar at an index.
template <class CellOf>
Block cells_of(const Bars& bars, int dim, std::size_t width, const CellOf& cell_of) {
  const auto [first, count] = bars.range_of(dim);
  std::vector<std::int64_t> numbers(count * width, -1);
  for (std::size_t k = 0; k < count; ++k) {
    const std::span<const Index> cell = cell_of(first + k);
    std::ranges::copy(cell.first(std::min(width, cell.size())),
                      numbers.begin() + static_cast<std::ptrdiff_t>(k * width));
  }
  return Block::of(std::move(numbers),
                   {static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(width)});
}

/// The number of integers that name a cell of a dimension.
std::size_t width_of(const Bars& bars, int dim) {
  const Barcode& all = bars.barcode;
  if (all.cell_kind() == CellKind::vertices) return static_cast<std::size_t>(dim + 1);
  return all.empty() ? 1 : all.birth_cell(0).numbers.size();
}

Block birth_cells(const Bars& bars, int dim) {
  return cells_of(bars, dim, width_of(bars, dim),
                  [&](std::size_t i) { return bars.barcode.birth_cell(i).numbers; });
}

Block death_cells(const Bars& bars, int dim) {
  return cells_of(bars, dim, width_of(bars, dim + 1), [&](std::size_t i) {
    const auto cell = bars.barcode.death_cell(i);
    return cell ? cell->numbers : std::span<const Index>();
  });
}

py::tuple chain(const Bars& bars, std::int64_t i) {
  const InputChain chain = bars.barcode.representative(place_in(bars, i));
  std::vector<std::int64_t> numbers, coefficients;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const std::span<const Index> cell = chain.cell(k).numbers;
    numbers.insert(numbers.end(), cell.begin(), cell.end());
    coefficients.push_back(chain.coefficient(k));
  }
  const auto size = static_cast<py::ssize_t>(chain.size());
  const auto width = size == 0 ? 0 : static_cast<py::ssize_t>(numbers.size()) / size;
  return py::make_tuple(Block::of(std::move(numbers), {size, width}),
                        Block::of(std::move(coefficients)));
}

/// The loops of a bar, each with its vertices, its coefficient and its length, and how tight the
/// loops are.
py::tuple loops_of(const Bars& bars, std::int64_t i) {
  const std::size_t place = place_in(bars, i);
  BarLoops own;
  if (bars.loops.empty()) own.loops = closed_walks(bars.barcode.representative(place), bars.field);
  const BarLoops& all = bars.loops.empty() ? own : bars.loops[place];
  // The birth cell of the bar need not be known, but its cycle is.
  const bool is_grid = bars.barcode.cell_kind() == CellKind::grid && !all.loops.empty();
  const std::size_t width =
      is_grid ? bars.barcode.representative(place).cell(0).numbers.size() : std::size_t{1};
  py::list loops;
  for (const Loop& loop : all.loops) {
    const auto vertices = static_cast<py::ssize_t>(loop.numbers.size() / width);
    loops.append(
        py::make_tuple(Block::of(loop.numbers, {vertices, static_cast<py::ssize_t>(width)}),
                       loop.coefficient, loop.length));
  }
  return py::make_tuple(loops, all.tightness);
}

/// The facts about the computation under the names that `Barcode.meta` gives them.
py::dict facts_of(const Bars& bars) {
  const BarcodeInfo& info = bars.barcode.info();
  py::dict named;
  named["max_dim"] = info.max_dim;
  if (info.threshold) named["threshold"] = *info.threshold;
  named["engine"] = info.engine;
  if (info.collapsed) named["collapsed"] = true;
  if (info.vertices) named["vertices"] = *info.vertices;
  if (info.edges) named["edges"] = *info.edges;
  if (info.subsample) named["covering_radius"] = info.subsample->covering_radius;
  if (info.alpha && !info.alpha->hidden.empty())
    named["hidden"] = py::tuple(py::cast(info.alpha->hidden));
  return named;
}

/// The rows birth, death of the bars of one dimension.
Block dgm(const Bars& bars, int dim) {
  const auto [first, count] = bars.range_of(dim);
  std::vector<double> rows;
  rows.reserve(2 * count);
  for (std::size_t i = first; i < first + count; ++i)
    rows.insert(rows.end(), {bars.barcode[i].birth, bars.barcode[i].death});
  return Block::of(std::move(rows), {static_cast<py::ssize_t>(count), 2});
}

py::buffer_info bytes_of_bars(const Bars& bars) {
  static_assert(sizeof(Bar) == 24 && offsetof(Bar, birth) == 8 && offsetof(Bar, death) == 16,
                "libph/_barcodes/_barcode.py knows the layout");
  const auto size = static_cast<py::ssize_t>(bars.barcode.size() * sizeof(Bar));
  auto* const first = size == 0 ? nullptr : const_cast<Bar*>(&bars.barcode[0]);
  return py::buffer_info(reinterpret_cast<unsigned char*>(first), size, true);
}

std::string svg_of(const Bars& bars, const std::string& title, bool negated,
                   const RunOptions& options) {
  PlotOptions look;
  look.title = title;
  look.negated = negated;
  if (negated) look.value_label = "Value, falling";
  return run(options, true, [&](const RunContext&) { return svg_plot(bars.barcode, look); });
}

/// The bars of a table. Python has checked that each of them is a bar.
Bars bars_of_columns(const py::buffer& dims, const py::buffer& births, const py::buffer& deaths) {
  const auto dim = vector_of<std::int64_t>(dims);
  const auto birth = vector_of<double>(births), death = vector_of<double>(deaths);
  Bars bars;
  bars.barcode.reserve_more(dim.size());
  for (std::size_t i = 0; i < dim.size(); ++i)
    bars.barcode.add({static_cast<int>(dim[i]), birth[i], death[i]});
  bars.barcode.sort();
  return bars;
}

template <class Numbers>
auto block_of_bar(Numbers&& numbers) {
  return [numbers](const Bars& bars, std::int64_t i) {
    return Block::copy_of(std::invoke(numbers, bars.barcode, place_in(bars, i)));
  };
}

}  // namespace

Bars::Range Bars::range_of(int dim) const {
  const auto range = std::ranges::equal_range(barcode.begin(), barcode.end(), dim, {}, &Bar::dim);
  return {static_cast<std::size_t>(range.begin() - barcode.begin()), range.size()};
}

void Bars::set_max_dim(int max_dim) {
  BarcodeInfo info = barcode.info();
  info.max_dim = max_dim;
  barcode.set_info(std::move(info));
}

void bind_bars(py::module_& m) {
  py::class_<Bars>(m, "Bars", py::buffer_protocol())
      .def_buffer(&bytes_of_bars)
      .def("__len__", [](const Bars& bars) { return bars.barcode.size(); })
      .def_property_readonly("facts", &facts_of)
      .def_property_readonly("top_dim",
                             [](const Bars& bars) {
                               const Barcode& all = bars.barcode;
                               return all.empty() ? -1 : all[all.size() - 1].dim;
                             })
      .def_readonly("field", &Bars::field)
      .def_property_readonly("p_values",
                             [](const Bars& bars) { return Block::of(std::vector(bars.p_values)); })
      .def_property_readonly("centroids",
                             [](const Bars& bars) { return Block::of(Points(bars.centroids)); })
      .def_property_readonly("cell_kind", [](const Bars& bars) { return bars.barcode.cell_kind(); })
      .def_property_readonly("has_cells",
                             [](const Bars& bars) {
                               return bars.barcode.empty() ||
                                      !bars.barcode.birth_cell(0).numbers.empty();
                             })
      .def_property_readonly("representatives",
                             [](const Bars& bars) { return bars.barcode.representatives(); })
      .def("dgm", &dgm, py::arg("dim"))
      .def("birth_cells", &birth_cells, py::arg("dim"))
      .def("death_cells", &death_cells, py::arg("dim"))
      .def("chain", &chain, py::arg("i"))
      .def("loops", &loops_of, py::arg("i"))
      .def("voxels", block_of_bar(&Barcode::voxels), py::arg("i"))
      .def("birth_voxel", block_of_bar(&Barcode::birth_voxel), py::arg("i"))
      .def("death_voxel", block_of_bar(&Barcode::death_voxel), py::arg("i"))
      .def(
          "selected",
          [](const Bars& bars, const py::buffer& places) {
            return selected(bars, vector_of<std::int64_t>(places));
          },
          py::arg("places"))
      .def("svg", &svg_of, py::arg("title"), py::arg("negated"), py::arg("run"))
      .def_static("of", &bars_of_columns, py::arg("dims"), py::arg("births"), py::arg("deaths"))
      .def("state", &state_of)
      .def_static(
          "from_state",
          [](const py::dict& state) {
            return of_state("a barcode", [&] { return bars_of_state(state); });
          },
          py::arg("state"));
}

}  // namespace ph::python
