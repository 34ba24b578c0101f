// SPDX-License-Identifier: MIT
#pragma once
#include "ph/io/cloud.hpp"

namespace ph::detail {

/// What stands before the data of a PCD file.
struct PcdHeader {
  Cloud cloud;  ///< all but the data
  std::size_t points = 0;
  std::size_t bytes = 0;   ///< points * stride
  std::size_t offset = 0;  ///< of the data in the file
  std::size_t lines = 0;   ///< before the data
  PcdData data = PcdData::ascii;
};

/// @throws Error (bad_data), also if the points that it promises do not fit the file.
PcdHeader read_pcd_header(const Input& input);

}  // namespace ph::detail
