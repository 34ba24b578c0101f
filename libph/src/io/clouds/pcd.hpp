// SPDX-License-Identifier: MIT
#pragma once
#include "ph/io/cloud.hpp"

namespace ph::detail {

/// The part of a PCD file before the data.
struct PcdHeader {
  Cloud cloud;  ///< everything except the data
  std::size_t points = 0;
  std::size_t bytes = 0;   ///< points * stride
  std::size_t offset = 0;  ///< start of the data in the file
  std::size_t lines = 0;   ///< lines before the data
  PcdData data = PcdData::ascii;
};

/// @throws Error (bad_data), also if the promised points do not fit the file.
PcdHeader read_pcd_header(const Input& input);

}  // namespace ph::detail
