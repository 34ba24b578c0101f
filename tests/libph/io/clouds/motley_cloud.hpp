// SPDX-License-Identifier: MIT
#pragma once
#include <cstring>
#include <limits>
#include <random>

#include "ph/io/cloud.hpp"

namespace ph::test {

/// An organised cloud with fields of every type, fields with several numbers per point, holes and
/// extreme numbers.
inline Cloud motley(Index width, Index height, bool wide_integers = true) {
  Cloud cloud;
  cloud.width = width;
  cloud.height = height;
  cloud.viewpoint = {1, 2, -3.5, 0.5, 0.5, -0.5, 0.5};
  const auto add = [&](const char* name, FieldType type, std::size_t count = 1) {
    cloud.fields.push_back({name, type, count, cloud.stride});
    cloud.stride += count * size_of(type);
  };
  add("x", FieldType::float32);
  add("y", FieldType::float32);
  add("z", FieldType::float32);
  add("rgb", FieldType::float32);
  add("label", FieldType::uint32);
  add("a", FieldType::int8);
  add("b", FieldType::uint8, 3);
  add("c", FieldType::int16);
  add("d", FieldType::uint16, 2);
  add("e", FieldType::int32);
  add("h", FieldType::float64, 5);
  if (wide_integers) {
    add("f", FieldType::int64);
    add("g", FieldType::uint64);
  }
  std::mt19937 random(7);
  cloud.data.resize(static_cast<std::size_t>(cloud.size()) * cloud.stride);
  for (std::size_t i = 0; i < cloud.data.size(); ++i) {
    cloud.data[i] = static_cast<std::byte>(i % 3 == 0 ? random() : 65);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(cloud.size()); ++i) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float xyzc[4] = {i % 4 == 1 ? nan : static_cast<float>(i) / 3, -1e-38f, 1e30f,
                           i % 5 == 2 ? nan : 2.3418052e-38f};
    std::memcpy(cloud.data.data() + i * cloud.stride, xyzc, sizeof(xyzc));
    const double five[5] = {0.1, -1e300, 4.9e-324, 3, static_cast<double>(i)};
    std::memcpy(cloud.data.data() + i * cloud.stride + cloud.find("h")->offset, five, sizeof(five));
  }
  return cloud;
}

}  // namespace ph::test
