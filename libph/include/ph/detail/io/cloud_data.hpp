// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ph/filtration.hpp"

namespace ph {

/// The type of a field of a cloud, as in PCD and PLY.
enum class FieldType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };
std::size_t size_of(FieldType type);

/// One field of each point: `count` numbers of one type, `offset` bytes into the point's record.
struct CloudField {
  std::string name;
  FieldType type = FieldType::float32;
  std::size_t count = 1;
  std::size_t offset = 0;
};

/// A point cloud as its file stores it: every field of every point, with its bytes unchanged, in
/// the order and organisation of the file. Point i is record i of `data`. A point with a NaN
/// coordinate is a hole that keeps its place.
struct Cloud {
  Index width = 0;   ///< columns of an organised cloud; otherwise the number of points
  Index height = 1;  ///< rows of an organised cloud; 1 if it is not organised
  /// Pose of the sensor: translation, quaternion w x y z.
  std::array<double, 7> viewpoint{0, 0, 0, 1, 0, 0, 0};
  std::vector<CloudField> fields;
  std::size_t stride = 0;  ///< bytes per point
  std::vector<std::byte> data;

  Index size() const { return width * height; }
  bool organised() const { return height > 1; }
  /// @throws Error (bad_data) unless `data` holds width * height records and each record holds its
  /// fields. All members below except `find` throw it as well.
  void check() const;
  const CloudField* find(std::string_view name) const;
  /// Appends a field of zeros to every point. @return the index of the field. Rewrites `data`.
  std::size_t add_field(std::string name, FieldType type, std::size_t count = 1);
  /// The x, y, z of every point as float32 triples (3 * size() numbers); NaN where the cloud has a
  /// hole. @throws Error (bad_data) if x, y or z is missing, or beyond single precision.
  std::vector<float> xyz() const;
  /// Divides x, y and z of the points and of the viewpoint by this number, which must be above 0.
  /// @throws Error (bad_data) if a coordinate is a field of whole numbers.
  void to_metres(double units_per_metre);
  /// The colours as packed 0x00RRGGBB, one per point; empty if the cloud has none.
  std::optional<std::vector<std::uint32_t>> rgb() const;
  /// Sets one number per point in a field of type uint32.
  void set_uint32(std::size_t field, const std::vector<std::uint32_t>& values);
};

}  // namespace ph
