// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "tests/libph/io/read_support.hpp"

namespace ph::test {

/// The voxels of an image of 2 x 3, as they are read.
inline const std::vector<double> kByRows{0, 1, 2, 10, 11, 12};

/// The same voxels in a file: numbers of a type, with the first axis fastest.
/// @param big true if the high byte comes first.
template <class T>
std::string six(bool big) {
  std::string bytes;
  for (const int number : {0, 10, 1, 11, 2, 12}) {
    std::string raw = le(static_cast<T>(number));
    if (big) std::reverse(raw.begin(), raw.end());
    bytes += raw;
  }
  return bytes;
}

}  // namespace ph::test
