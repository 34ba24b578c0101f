// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ph/detail/report/provenance.hpp"
#include "ph/run_context.hpp"

namespace ph::report {

/// The types of numbers in an array.
template <class T>
concept ArrayNumber = std::same_as<T, std::uint8_t> || std::same_as<T, std::int8_t> ||
    std::same_as<T, std::uint16_t> || std::same_as<T, std::int16_t> ||
    std::same_as<T, std::uint32_t> || std::same_as<T, std::int32_t> || std::same_as<T, float> ||
    std::same_as<T, double>;

/// The interpretation of an array.
struct ArrayForm {
  /// Sizes of the axes, the last one fastest; empty: one axis.
  std::vector<std::size_t> shape = {};
  bool delta = false;  ///< store differences from the previous row (integers only)
  /// One offset and scale, or one per column: a number means offset + scale * stored. If both are
  /// empty, the stored number is the number itself.
  std::vector<double> offset = {}, scale = {};
};

/// The numbers of an array as bytes, with their type.
struct RawArray {
  std::string_view name;  ///< a name such as "bars/birth"
  std::string_view type;  ///< a type such as "f64"
  std::size_t width;      ///< bytes per number, in the byte order of this machine
  std::span<const std::byte> bytes;
  bool is_in_file = false;  ///< see ph/detail/core/file_pages.hpp
};

/// Writes an array as docs/reference/report-format.md describes: filters, zlib, base64, in an
/// element of its own. Numbers of more than one byte are stored as planes. In addition to the
/// array, this takes constant memory. Of an array in a file, at most one block is in memory at a
/// time.
/// @throws Error (cancelled); std::bad_alloc; errors of `sink`.
void write_array(const Sink& sink, const RawArray& array, const ArrayForm& form,
                 const RunContext& context);

template <ArrayNumber T>
RawArray raw_array(std::string_view name, std::span<const T> numbers) {
  constexpr std::string_view type = std::same_as<T, std::uint8_t>    ? "u8"
                                    : std::same_as<T, std::int8_t>   ? "i8"
                                    : std::same_as<T, std::uint16_t> ? "u16"
                                    : std::same_as<T, std::int16_t>  ? "i16"
                                    : std::same_as<T, std::uint32_t> ? "u32"
                                    : std::same_as<T, std::int32_t>  ? "i32"
                                    : std::same_as<T, float>         ? "f32"
                                                                     : "f64";
  return {name, type, sizeof(T), std::as_bytes(numbers)};
}

}  // namespace ph::report
