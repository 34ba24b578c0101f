// SPDX-License-Identifier: MIT
#pragma once
// This header declares arrays that Python passes or receives. They use only the buffer protocol, so
// the module works with any version of NumPy.
#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "ph/error.hpp"
#include "ph/image.hpp"
#include "ph/points.hpp"
#include "ph/run_context.hpp"

namespace ph::python {

namespace py = pybind11;

/// The letter of a number type in the buffer protocol. For int64, it is the letter of NumPy's own
/// int64.
template <class T>
std::string letter_of() {
  if (std::is_same_v<T, std::int64_t> && sizeof(long) == sizeof(T)) return "l";
  return py::format_descriptor<T>::format();
}

/// An array for Python. The array keeps its numbers alive.
class Block {
 public:
  /// @param shape the lengths of the axes, whose product is the number of numbers.
  template <class T>
  static Block of(std::vector<T> numbers, std::vector<py::ssize_t> shape) {
    auto owner = std::make_shared<std::vector<T>>(std::move(numbers));
    return Block(std::shared_ptr<void>(owner, owner->data()), sizeof(T), letter_of<T>(),
                 std::move(shape), false);
  }
  template <class T>
  static Block of(std::vector<T> numbers) {
    const auto size = static_cast<py::ssize_t>(numbers.size());
    return of(std::move(numbers), {size});
  }
  template <class T>
  static Block copy_of(std::span<const T> numbers) {
    return of(std::vector<T>(numbers.begin(), numbers.end()));
  }
  /// Takes the points without a copy.
  static Block of(Points&& points);
  /// Shares the numbers of the image without a copy. Numbers that stay in a file are read-only.
  /// @param context the context in which the image was made, if the memory of the image may count
  /// in the budget of this context.
  static Block of(const Image& image, std::shared_ptr<const RunContext> context = nullptr);

  /// The buffer in the form that Python's protocol requires.
  py::buffer_info info() const;

 private:
  Block(std::shared_ptr<void> data, std::size_t item, std::string format,
        std::vector<py::ssize_t> shape, bool is_read_only)
      : data_(std::move(data)),
        item_(static_cast<py::ssize_t>(item)),
        format_(std::move(format)),
        shape_(std::move(shape)),
        is_read_only_(is_read_only) {}

  std::shared_ptr<void> data_;
  py::ssize_t item_;
  std::string format_;
  std::vector<py::ssize_t> shape_;
  bool is_read_only_;
};

/// True if the numbers of an array have this type.
template <class T>
bool holds(const py::buffer_info& array) {
  if (array.itemsize != sizeof(T) || array.format.size() != 1) return false;
  const char letter = array.format[0];
  const std::string_view letters = std::is_floating_point_v<T> ? "fd"
                                   : std::is_signed_v<T>       ? std::string_view("bhilq")
                                                               : std::string_view("BHILQ");
  return letters.find(letter) != std::string_view::npos;
}

/// The numbers of a contiguous array with one axis.
/// @throws Error (internal) on any other array, because the Python modules must have prepared it.
template <class T>
std::span<const T> numbers_of(const py::buffer_info& array) {
  if (!holds<T>(array) || array.ndim != 1 || (array.size > 1 && array.strides[0] != array.itemsize))
    throw Error(ErrorKind::internal, "an array of the wrong type or layout reached _core");
  return {static_cast<const T*>(array.ptr), static_cast<std::size_t>(array.size)};
}
template <class T>
std::vector<T> vector_of(const py::buffer& array) {
  const py::buffer_info info = array.request();
  const std::span<const T> numbers = numbers_of<T>(info);
  return {numbers.begin(), numbers.end()};
}

/// The type of the numbers of an image. @throws Error (internal) if images cannot have this type.
VoxelType voxel_type_of(const py::buffer_info& array);

/// The points of a float64 array with one point per row. Strides may be any multiples of the item
/// size.
PointsView points_of(const py::buffer_info& array);

}  // namespace ph::python
