// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

#include "ph/detail/io/cloud_data.hpp"

namespace ph::detail {

/// Calls `visit` with a value of the C++ type of a field.
template <class Visit>
auto visit_type(FieldType type, Visit&& visit) {
  switch (type) {
    case FieldType::int8:
      return visit(std::int8_t{});
    case FieldType::uint8:
      return visit(std::uint8_t{});
    case FieldType::int16:
      return visit(std::int16_t{});
    case FieldType::uint16:
      return visit(std::uint16_t{});
    case FieldType::int32:
      return visit(std::int32_t{});
    case FieldType::uint32:
      return visit(std::uint32_t{});
    case FieldType::int64:
      return visit(std::int64_t{});
    case FieldType::uint64:
      return visit(std::uint64_t{});
    case FieldType::float32:
      return visit(float{});
    case FieldType::float64:
      break;
  }
  return visit(double{});
}

}  // namespace ph::detail
