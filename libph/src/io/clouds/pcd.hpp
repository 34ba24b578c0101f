// SPDX-License-Identifier: MIT
#pragma once
#include "ph/io/cloud.hpp"

namespace ph::detail {

/// The part of a PCD file before the data.
struct PcdHeader {
  Cloud cloud;  ///< everything except the data
  std::size_t points = 0;
  std::size_t bytes = 0;   ///< points * stride
  std::size_t offset = 0;  ///< the start of the data in the file
  std::size_t lines = 0;   ///< the number of lines before the data
  PcdData data = PcdData::ascii;
};

/// Reads the header of a PCD file. @throws Error (bad_data) if it is invalid, or if the file is too
/// small for the points that it states.
PcdHeader read_pcd_header(const Input& input);

}  // namespace ph::detail
