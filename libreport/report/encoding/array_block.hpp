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

/// What the numbers of an array may be.
template <class T>
concept ArrayNumber = std::same_as<T, std::uint8_t> || std::same_as<T, std::int8_t> ||
    std::same_as<T, std::uint16_t> || std::same_as<T, std::int16_t> ||
    std::same_as<T, std::uint32_t> || std::same_as<T, std::int32_t> || std::same_as<T, float> ||
    std::same_as<T, double>;

/// How an array is to be understood.
struct ArrayForm {
  std::vector<std::size_t> shape =
      {};              ///< sizes of the axes, the last one fastest; empty: one axis
  bool delta = false;  ///< store differences from the row before (integers only)
  /// One of each, or one a column: a number means offset + scale * stored. Empty: the number
  /// itself.
  std::vector<double> offset = {}, scale = {};
};

/// What is written of an array: numbers of a type as bytes.
struct RawArray {
  std::string_view name;  ///< "bars/birth"
  std::string_view type;  ///< "f64"
  std::size_t width;      ///< bytes a number, in the order of this machine
  std::span<const std::byte> bytes;
  bool is_in_file = false;  ///< see ph/detail/core/file_pages.hpp
};

/// Writes an array as docs/reference/report-format.md says: filters, zlib, base64, in an element of
/// its own. Numbers of more than a byte are stored as planes. Memory beside the array: a constant;
/// of an array in a file no more than a block is in memory.
/// @throws Error (cancelled); std::bad_alloc; what `sink` throws.
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
