// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/libph/io/read_support.hpp"

namespace ph::test {

/// A NIfTI-1 file, which may be invalid.
struct Nifti {
  std::vector<std::int16_t> dim{2, 2, 3};
  std::int16_t datatype = 4, bitpix = 16;
  float offset = 352, slope = 0, intercept = 0;
  std::string magic = std::string("n+1\0", 4);
  std::int32_t size = 348;
  bool big = false;

  template <class T>
  void put(std::string& bytes, std::size_t at, T value) const {
    std::string raw = le(value);
    if (big) std::reverse(raw.begin(), raw.end());
    std::copy(raw.begin(), raw.end(), bytes.data() + at);
  }
  std::string header() const {
    std::string bytes(352, '\0');
    put(bytes, 0, size);
    for (std::size_t i = 0; i < dim.size(); ++i) put(bytes, 40 + 2 * i, dim[i]);
    put(bytes, 70, datatype);
    put(bytes, 72, bitpix);
    put(bytes, 108, offset);
    put(bytes, 112, slope);
    put(bytes, 116, intercept);
    std::copy_n(magic.begin(), 4, bytes.data() + 344);
    return bytes;
  }
  template <class T>
  std::string with(const std::vector<T>& values) const {
    std::string bytes = header();
    for (const T value : values) {
      bytes.resize(bytes.size() + sizeof(T));
      put(bytes, bytes.size() - sizeof(T), value);
    }
    return bytes;
  }
};

}  // namespace ph::test
