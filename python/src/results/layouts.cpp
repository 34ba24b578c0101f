// SPDX-License-Identifier: MIT
// This file returns bars in the forms and in the orders of other packages.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "ph/error.hpp"
#include "python/src/calls/bindings.hpp"
#include "python/src/data/arrays.hpp"
#include "python/src/results/bars.hpp"

namespace ph::python {
namespace {

/// A list of (dim, (birth, death)): the highest dimension first, within a dimension the longest bar
/// first, and equally long bars by birth.
py::list listed(const Bars& bars) {
  std::vector<Bar> all(bars.barcode.begin(), bars.barcode.end());
  std::ranges::sort(all, [](const Bar& a, const Bar& b) {
    return std::tuple(-a.dim, -a.persistence(), a.birth, a.death) <
           std::tuple(-b.dim, -b.persistence(), b.birth, b.death);
  });
  py::list list(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    list[i] = py::make_tuple(all[i].dim, py::make_tuple(all[i].birth, all[i].death));
  return list;
}

double rounded_to_single(double number) {
  static_assert(std::numeric_limits<float>::is_iec559, "numbers out of range become infinite");
  return static_cast<float>(number);
}

/// How Ripser and its descendants show bars.
struct RipserForm {
  bool is_single;       ///< births and deaths are rounded to single precision
  bool essential_last;  ///< above H0, bars that never die follow the others
  /// If there are any, births and deaths are indices of these values.
  std::span<const double> levels;

  Bar shown(Bar bar) const {
    for (double* const value : {&bar.birth, &bar.death}) {
      if (!levels.empty() && std::isfinite(*value))
        *value = levels[static_cast<std::size_t>(*value)];
      if (is_single) *value = rounded_to_single(*value);
    }
    return bar;
  }
  /// H0 is ordered by death and birth; other dimensions by descending birth and descending death.
  bool is_before(const Bar& a, const Bar& b) const {
    if (a.dim == 0) return std::tie(a.death, a.birth) < std::tie(b.death, b.birth);
    if (essential_last && a.is_infinite() != b.is_infinite()) return b.is_infinite();
    return std::tie(a.birth, a.death) > std::tie(b.birth, b.death);
  }
};

/// For each dimension, the rows birth, death of bars of positive length, and their indices.
py::list ripser_dgms(const Bars& bars, int max_dim, bool is_single, bool essential_last,
                     const std::optional<py::buffer>& levels) {
  const std::vector<double> numbers = levels ? vector_of<double>(*levels) : std::vector<double>();
  const RipserForm form{is_single, essential_last, numbers};
  py::list dgms;
  for (int dim = 0; dim <= max_dim; ++dim) {
    const auto [first, count] = bars.range_of(dim);
    std::vector<Bar> shown(count);
    std::vector<std::int64_t> places;
    for (std::size_t k = 0; k < count; ++k) {
      shown[k] = form.shown(bars.barcode[first + k]);
      if (shown[k].birth != shown[k].death) places.push_back(static_cast<std::int64_t>(k));
    }
    std::ranges::stable_sort(places, [&](std::int64_t a, std::int64_t b) {
      return form.is_before(shown[static_cast<std::size_t>(a)], shown[static_cast<std::size_t>(b)]);
    });
    std::vector<double> rows;
    rows.reserve(2 * places.size());
    for (std::int64_t& place : places) {
      const Bar& bar = shown[static_cast<std::size_t>(place)];
      rows.insert(rows.end(), {bar.birth, bar.death});
      place += static_cast<std::int64_t>(first);
    }
    const auto size = static_cast<py::ssize_t>(places.size());
    dgms.append(
        py::make_tuple(Block::of(std::move(rows), {size, 2}), Block::of(std::move(places))));
  }
  return dgms;
}

}  // namespace

void bind_layouts(py::module_& m) {
  m.def("listed", &listed, py::arg("bars"));
  m.def("ripser_dgms", &ripser_dgms, py::arg("bars"), py::arg("max_dim"), py::arg("is_single"),
        py::arg("essential_last"), py::arg("levels"));
}

}  // namespace ph::python
