// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <cstring>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/io/cloud.hpp"

namespace ph {
namespace {

bool has_known_start(const Input& input) {
  return detail::is_npy(input) || detail::is_png(input) || detail::is_pgm(input);
}

}  // namespace

Input::StartCheck depth_start_check() {
  return [](const Input& start) {
    if (!has_known_start(start)) read_depth(start);  // says what is there
  };
}

DepthImage read_depth(const Input& input, const ReadOptions& options) {
  ReadOptions holes = options;
  holes.nan = NanPolicy::drop;
  holes.note = {};  // holes of a depth image need no note
  if (!has_known_start(input)) {
    input.fail({"not a depth image", "another format", "a grey PNG, PGM or NPY",
                "save an image in any other format with numpy.save"});
  }
  // Readers of pictures accept colours if an option chooses a channel, but a depth image has no
  // option for this.
  const auto read_grey = [&] {
    Raster raster = read_png(input);
    if (raster.channels > 1)
      input.fail({"depth image", fmt::format("{} channels", raster.channels), "1 (grey)", {}});
    return detail::image_of(std::move(raster), input, holes);
  };
  DepthImage result{detail::is_png(input) ? read_grey() : read_image(input, holes)};
  if (result.depth.extents.size() != 2) {
    input.fail({"depth image",
                fmt::format("shape ({})", fmt::join(result.depth.extents, ", ")),
                "two axes: rows, columns",
                {}});
  }
  if (detail::is_npy(input) && detail::is_npy_of_floats(input))
    result.scale = 1;  // mutant: depth-scale
  return result;
}

Cloud cloud_from_depth(const Image& depth, const std::optional<Raster>& colour,
                       const Camera& camera, double depth_scale, DepthCounts* counts) {
  const auto& [fx, fy, cx, cy] = camera.intrinsics;
  if (!(fx > 0) || !(fy > 0) || !(depth_scale > 0) ||
      !std::isfinite(fx + fy + cx + cy + depth_scale)) {
    throw Error(ErrorKind::usage,
                fmt::format("{}: found focal lengths {} and {}, centre {} {}, depth scale {}, "
                            "expected finite numbers, lengths and scale above 0",
                            mark(Setting::intrinsics), fx, fy, cx, cy, depth_scale));
  }
  if (colour) colour->check();
  if (depth.extents.size() != 2) {
    throw Error(ErrorKind::usage,
                fmt::format("depth image: found {} axes, expected 2: rows and columns",
                            depth.extents.size()));
  }
  const Index height = depth.extents[0], width = depth.extents[1];
  if (height < 0 || width < 0 ||
      depth.values.size() !=
          checked_product(static_cast<std::size_t>(height), static_cast<std::size_t>(width))) {
    throw Error(ErrorKind::bad_data, fmt::format("depth image: found {} values, expected {} x {}",
                                                 depth.values.size(), width, height));
  }
  if (camera.width != 0 && (camera.width != width || camera.height != height)) {
    throw Error(ErrorKind::usage,
                fmt::format("{}: found an image of {} x {} pixels, expected {} x {}",
                            mark(Setting::intrinsics), width, height, camera.width, camera.height));
  }
  if (colour && (colour->width != width || colour->height != height)) {
    throw Error(ErrorKind::bad_data,
                fmt::format("{}: colour image: found {} x {} pixels, expected {} x {} as in the "
                            "depth image; register depth and colour first",
                            colour->name, colour->width, colour->height, width, height));
  }
  Cloud cloud;
  cloud.width = width;
  cloud.height = height;
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
  DepthCounts found;
  std::byte* record = cloud.data.data();
  const double reach = camera.lens.reach();
  for (Index v = 0; v < height; ++v) {
    for (Index u = 0; u < width; ++u, record += cloud.stride) {
      constexpr double hole = std::numeric_limits<double>::quiet_NaN();
      const double raw = depth.values[static_cast<std::size_t>(v * width + u)];
      const double z = raw > 0 && std::isfinite(raw) ? raw / depth_scale : hole;
      if (raw < 0) ++found.negative;
      const double right = static_cast<double>(u) - cx, down = static_cast<double>(v) - cy;
      std::array<double, 3> place{right * z / fx, down * z / fy, z};
      if (camera.lens.model != Lens::Model::none && !std::isnan(z)) {
        const auto ray = camera.lens.straightened(right / fx, down / fy, reach);
        if (!ray) ++found.unseen;
        place = ray ? std::array{(*ray)[0] * z, (*ray)[1] * z, z} : std::array{hole, hole, hole};
      }
      const std::array<float, 3> point{static_cast<float>(place[0]), static_cast<float>(place[1]),
                                       static_cast<float>(place[2])};
      std::memcpy(record, point.data(), sizeof(point));
      if (!colour) continue;
      const bool grey = colour->channels < 3;
      std::uint32_t rgba = 0xFF;  // the colour is opaque
      for (int channel = 0; channel < 3; ++channel) {
        const unsigned sample = colour->at(u, v, grey ? 0 : channel);
        rgba = rgba << 8 | (colour->bits == 16 ? sample >> 8 : sample);
      }
      std::memcpy(record + colour_offset, &rgba, sizeof(rgba));
    }
  }
  if (counts != nullptr) *counts = found;
  return cloud;
}

}  // namespace ph
