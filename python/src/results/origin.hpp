// SPDX-License-Identifier: MIT
#pragma once
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "ph/io/write.hpp"

namespace ph::python {

namespace py = pybind11;

/// Converts the origin of a barcode, as far as files can state it, from the form in Python, and
/// back.
BarcodeInfo info_of(const py::dict& meta);
py::dict meta_of(const BarcodeInfo& info);

}  // namespace ph::python
