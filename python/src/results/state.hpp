// SPDX-License-Identifier: MIT
#pragma once
#include <pybind11/pybind11.h>

#include <fmt/format.h>

#include "ph/error.hpp"

namespace ph::python {

namespace py = pybind11;

/// The result of `take` for the members of a pickled state. Members may be missing or have any
/// type.
/// @param thing the kind of object, such as "a barcode".
/// @throws Error (bad_data).
template <class Take>
auto of_state(const char* thing, const Take& take) {
  try {
    return take();
    // A member does not have the requested type.
  } catch (const py::builtin_exception&) {
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_Exception) || error.matches(PyExc_MemoryError)) throw;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::internal) throw;  // a member is an array of another type
  }
  throw Error(ErrorKind::bad_data, fmt::format("state of {}: found damaged members", thing));
}

}  // namespace ph::python
