// SPDX-License-Identifier: MIT
#pragma once
// These functions add the parts of the module. There is one file for each part, and the parts are
// added in this order.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <concepts>
#include <string>

#include "ph/detail/core/names.hpp"

namespace pybind11::detail {

/// In Python, a value of an enum with names is represented by its name.
template <class Enum>
requires(std::is_enum_v<Enum>&& ph::names_of<Enum>.size() > 0) class type_caster<Enum> {
 public:
  PYBIND11_TYPE_CASTER(Enum, const_name("str"));
  bool load(handle source, bool) {
    const auto named =
        isinstance<str>(source) ? ph::value_named<Enum>(source.cast<std::string>()) : std::nullopt;
    if (named) value = *named;
    return named.has_value();
  }
  static handle cast(Enum value, return_value_policy, handle) {
    return str(std::string(ph::name_of(value))).release();
  }
};

}  // namespace pybind11::detail

namespace ph::python {

namespace py = pybind11;

void bind_errors(py::module_& m);
void bind_run(py::module_& m);
void bind_arrays(py::module_& m);
void bind_metric_spaces(py::module_& m);
void bind_flags(py::module_& m);
void bind_bars(py::module_& m);
void bind_layouts(py::module_& m);
void bind_complexes(py::module_& m);
void bind_alpha(py::module_& m);
void bind_computations(py::module_& m);
void bind_image_loops(py::module_& m);
void bind_image_parts(py::module_& m);
void bind_cloud_parts(py::module_& m);
void bind_distances(py::module_& m);
void bind_significance(py::module_& m);
void bind_vectors(py::module_& m);
void bind_kernels(py::module_& m);
void bind_euler_curves(py::module_& m);
void bind_merge_trees(py::module_& m);
void bind_clusters(py::module_& m);
void bind_files(py::module_& m);
void bind_clouds(py::module_& m);
void bind_segmentations(py::module_& m);
void bind_reports(py::module_& m);

}  // namespace ph::python
