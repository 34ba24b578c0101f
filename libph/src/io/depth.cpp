// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>

#include "ph/io/cloud_io.hpp"

namespace ph {
Cloud cloud_from_depth(const Raster& depth, const std::optional<Raster>& colour,
                       const Intrinsics& intrinsics, double depth_scale) {
  const auto& [fx, fy, cx, cy] = intrinsics;
  if (!(fx > 0) || !(fy > 0) || !(depth_scale > 0) ||
      !std::isfinite(fx + fy + cx + cy + depth_scale)) {
    throw Error(ErrorKind::usage,
                fmt::format("camera: found focal lengths {} and {}, centre {} {}, depth scale {}, "
                            "expected finite numbers, lengths and scale above 0",
                            fx, fy, cx, cy, depth_scale));
  }
  depth.check();
  if (colour) colour->check();
  if (depth.channels != 1) {
    throw Error(ErrorKind::bad_data,
                fmt::format("{}: depth image: found {} channels, expected 1 (grey)", depth.name,
                            depth.channels));
  }
  if (colour && (colour->width != depth.width || colour->height != depth.height)) {
    throw Error(
        ErrorKind::bad_data,
        fmt::format(
            "{}: colour image: found {} x {} pixels, expected {} x {} as in the depth image",
            colour->name, colour->width, colour->height, depth.width, depth.height));
  }
  Cloud cloud;
  cloud.width = depth.width;
  cloud.height = depth.height;
  for (const char* name : {"x", "y", "z"}) {
    cloud.fields.push_back({name, FieldType::float32, 1, cloud.stride});
    cloud.stride += sizeof(float);
  }
  const std::size_t colour_offset = cloud.stride;
  if (colour) {
    cloud.fields.push_back({"rgba", FieldType::uint32, 1, cloud.stride});
    cloud.stride += sizeof(std::uint32_t);
  }
  cloud.data.resize(static_cast<std::size_t>(cloud.size()) * cloud.stride);
  std::byte* record = cloud.data.data();
  for (Index v = 0; v < depth.height; ++v) {
    for (Index u = 0; u < depth.width; ++u, record += cloud.stride) {
      const double raw = depth.at(u, v);
      const double z = raw > 0 ? raw / depth_scale : std::numeric_limits<double>::quiet_NaN();
      const std::array<float, 3> point{static_cast<float>((static_cast<double>(u) - cx) * z / fx),
                                       static_cast<float>((static_cast<double>(v) - cy) * z / fy),
                                       static_cast<float>(z)};
      std::memcpy(record, point.data(), sizeof(point));
      if (!colour) continue;
      const bool grey = colour->channels < 3;
      std::uint32_t rgba = 0xFF;  // opaque
      for (int channel = 0; channel < 3; ++channel) {
        const unsigned sample = colour->at(u, v, grey ? 0 : channel);
        rgba = rgba << 8 | (colour->bits == 16 ? sample >> 8 : sample);
      }
      std::memcpy(record + colour_offset, &rgba, sizeof(rgba));
    }
  }
  return cloud;
}

}  // namespace ph
