// SPDX-License-Identifier: MIT
#include "ph/detail/io/cloud_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstring>
#include <limits>
#include <utility>

#include "libph/src/io/bytes/field_access.hpp"
#include "libph/src/io/bytes/readers.hpp"
#include "ph/io/cloud.hpp"

namespace ph {
namespace {

const CloudField& coordinate(const Cloud& cloud, std::string_view name) {
  const CloudField* field = cloud.find(name);
  if (field == nullptr || field->count != 1) {
    throw Error(ErrorKind::bad_data, fmt::format("cloud: no field {}, expected x, y and z", name));
  }
  return *field;
}

// Calls put(point, axis, value) for every coordinate, field by field.
template <class Put>
void for_each_coordinate(const Cloud& cloud, Put put) {
  std::size_t axis = 0;
  for (const std::string_view name : {"x", "y", "z"}) {
    const CloudField& field = coordinate(cloud, name);
    const auto size = static_cast<std::size_t>(cloud.size());
    detail::visit_type(field.type, [&]<class T>(T) {
      for (std::size_t i = 0; i < size; ++i) {
        const std::byte* from = cloud.data.data() + i * cloud.stride + field.offset;
        put(i, axis, load<T>(from, std::endian::native));
      }
    });
    ++axis;
  }
}

}  // namespace

namespace detail {

void name_coordinates(Cloud& cloud) {
  for (const auto& [capital, small] : {std::pair{"X", "x"}, {"Y", "y"}, {"Z", "z"}}) {
    const auto named = std::ranges::find(cloud.fields, capital, &CloudField::name);
    if (named != cloud.fields.end() && cloud.find(small) == nullptr) named->name = small;
  }
}

void to_native(Cloud& cloud) {
  if constexpr (std::endian::native == std::endian::little) return;
  for (const CloudField& field : cloud.fields) {
    const std::size_t width = size_of(field.type);
    for (std::size_t i = 0; i < static_cast<std::size_t>(cloud.size()); ++i) {
      std::byte* at = cloud.data.data() + i * cloud.stride + field.offset;
      for (std::size_t k = 0; k < field.count; ++k)
        std::reverse(at + k * width, at + (k + 1) * width);
    }
  }
}

}  // namespace detail

std::size_t size_of(FieldType type) {
  return detail::visit_type(type, []<class T>(T) { return sizeof(T); });
}

void Cloud::check() const {
  const auto refuse = [](const std::string& found, const std::string& expected) {
    throw Error(ErrorKind::bad_data, fmt::format("cloud: found {}, expected {}", found, expected));
  };
  if (width < 0 || height < 0)
    refuse(fmt::format("{} x {} points", width, height), "sizes of 0 or more");
  const auto points =
      checked_product(static_cast<std::size_t>(width), static_cast<std::size_t>(height));
  const auto bytes = points ? checked_product(*points, stride) : std::nullopt;
  if (!bytes || *bytes != data.size() || !std::in_range<Index>(*points))
    refuse(fmt::format("{} bytes", data.size()),
           fmt::format("{} x {} points of {} bytes", width, height, stride));
  for (const CloudField& field : fields) {
    const auto size = checked_product(field.count, size_of(field.type));
    if (!size || *size > stride || field.offset > stride - *size)
      refuse(fmt::format("field {} of {} numbers from byte {} on", printable(field.name, 100),
                         field.count, field.offset),
             fmt::format("it inside the {} bytes of a point", stride));
  }
}

const CloudField* Cloud::find(std::string_view name) const {
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [name](const CloudField& field) { return field.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

std::size_t Cloud::add_field(std::string name, FieldType type, std::size_t count) {
  check();
  const auto more = checked_product(size_of(type), count);
  const std::size_t wider = more && *more <= SIZE_MAX - stride ? stride + *more : SIZE_MAX;
  const auto points = static_cast<std::size_t>(size());
  const auto bytes = checked_product(points, wider);
  if (!bytes || *bytes > std::numeric_limits<std::ptrdiff_t>::max())
    throw Error(ErrorKind::resource, fmt::format("cloud: too large to add the field {}", name));
  std::vector<std::byte> wide(*bytes);
  for (std::size_t i = 0; i < points && stride > 0; ++i) {
    std::memcpy(wide.data() + i * wider, data.data() + i * stride, stride);
  }
  data = std::move(wide);
  fields.push_back({std::move(name), type, count, stride});
  stride = wider;
  return fields.size() - 1;
}

std::vector<float> Cloud::xyz() const {
  check();
  std::vector<float> result(static_cast<std::size_t>(size()) * 3);
  for_each_coordinate(*this, [&](std::size_t i, std::size_t axis, auto value) {
    if constexpr (std::same_as<decltype(value), double>)
      if (std::isfinite(value) && std::abs(value) > std::numeric_limits<float>::max())
        throw Error(
            ErrorKind::bad_data,
            fmt::format("point {}, coordinate {}: found {}, expected at most {} in absolute "
                        "value (single precision)",
                        i, axis, value, std::numeric_limits<float>::max()));
    result[3 * i + axis] = static_cast<float>(value);
  });
  return result;
}

void Cloud::to_metres(double units_per_metre) {
  check();
  for (const std::string_view name : {"x", "y", "z"}) {
    const CloudField& field = coordinate(*this, name);
    detail::visit_type(field.type, [&]<class T>(T) {
      if constexpr (!std::is_floating_point_v<T>) {
        throw Error(ErrorKind::bad_data,
                    fmt::format("cloud: found the field {} of whole numbers, which cannot hold "
                                "metres, expected floats",
                                name));
      } else {
        for (std::size_t i = 0; i < static_cast<std::size_t>(size()); ++i) {
          std::byte* at = data.data() + i * stride + field.offset;
          const T value = static_cast<T>(load<T>(at, std::endian::native) / units_per_metre);
          std::memcpy(at, &value, sizeof value);
        }
      }
    });
  }
  for (std::size_t k = 0; k < 3; ++k) viewpoint[k] /= units_per_metre;
}

std::optional<std::vector<std::uint32_t>> Cloud::rgb() const {
  check();
  const auto points = static_cast<std::size_t>(size());
  std::vector<std::uint32_t> result(points);
  // The colour is packed into an integer or a float.
  for (const std::string_view name : {"rgba", "rgb"}) {
    const CloudField* field = find(name);
    if (field == nullptr || field->count != 1 || size_of(field->type) != 4) continue;
    for (std::size_t i = 0; i < points; ++i) {
      result[i] =
          load<std::uint32_t>(data.data() + i * stride + field->offset, std::endian::native) &
          0xFFFFFF;
    }
    return result;
  }
  constexpr std::array<std::array<std::string_view, 3>, 3> kNames{
      {{"red", "green", "blue"},
       {"r", "g", "b"},
       {"diffuse_red", "diffuse_green", "diffuse_blue"}}};
  for (const auto& names : kNames) {
    const std::array<const CloudField*, 3> parts{find(names[0]), find(names[1]), find(names[2])};
    if (std::any_of(parts.begin(), parts.end(),
                    [](const CloudField* part) { return part == nullptr || part->count != 1; })) {
      continue;
    }
    for (const CloudField* part : parts) {
      detail::visit_type(part->type, [&]<class T>(T) {
        for (std::size_t i = 0; i < points; ++i) {
          const auto value = static_cast<double>(
              load<T>(data.data() + i * stride + part->offset, std::endian::native));
          // 16-bit channels and floating-point channels (0…1) are converted to 8 bits. NaN becomes
          // 0.
          const double scaled = std::is_floating_point_v<T> ? value * 255 + 0.5
                                : sizeof(T) == 2            ? value / 257
                                                            : value;
          const std::uint32_t byte = scaled >= 255 ? 255U
                                     : scaled > 0  ? static_cast<std::uint32_t>(scaled)
                                                   : 0U;
          result[i] = result[i] << 8 | byte;
        }
      });
    }
    return result;
  }
  return std::nullopt;
}

void Cloud::set_uint32(std::size_t field, const std::vector<std::uint32_t>& values) {
  check();
  if (field >= fields.size() || fields[field].type != FieldType::uint32 ||
      values.size() != static_cast<std::size_t>(size())) {
    throw Error(ErrorKind::internal,
                "cloud: set_uint32 needs a uint32 field and one value per point");
  }
  const std::size_t offset = fields[field].offset;
  for (std::size_t i = 0; i < values.size(); ++i)
    std::memcpy(data.data() + offset + i * stride, &values[i], sizeof(std::uint32_t));
}

Points points_of(const Cloud& cloud) {
  cloud.check();
  Points points(cloud.size(), 3);
  for_each_coordinate(cloud, [&](std::size_t i, std::size_t axis, auto value) {
    points(static_cast<Index>(i), static_cast<Index>(axis)) = static_cast<double>(value) + 0.0;
  });
  return points;
}

}  // namespace ph
