// SPDX-License-Identifier: MIT
#pragma once
// This header handles parts as bytes, which is the form in which parts are sent between processes
// and stored in files.
#include <pybind11/pybind11.h>

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace ph::python {

namespace py = pybind11;

inline py::bytes to_python(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
/// Returns a view that is valid as long as Python keeps the bytes.
inline std::span<const std::byte> view_of(const py::bytes& bytes) {
  const std::string_view text = bytes;
  return std::as_bytes(std::span(text));
}
inline std::vector<std::span<const std::byte>> views_of(const std::vector<py::bytes>& all) {
  std::vector<std::span<const std::byte>> views;
  for (const py::bytes& bytes : all) views.push_back(view_of(bytes));
  return views;
}

}  // namespace ph::python
