// SPDX-License-Identifier: MIT
#pragma once
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "ph/io/write.hpp"

namespace ph::python {

namespace py = pybind11;

/// What Python knows of a barcode, as far as files say it; and back.
BarcodeInfo info_of(const py::dict& meta);
py::dict meta_of(const BarcodeInfo& info);

}  // namespace ph::python
