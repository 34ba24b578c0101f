// SPDX-License-Identifier: MIT
#include "ph/detail/segment/label_files.hpp"

#include <fmt/format.h>

#include <sstream>

#include "ph/detail/io/png.hpp"
#include "ph/error.hpp"
#include "ph/io/cloud.hpp"

namespace ph::segment {
namespace {

Raster label_image(const SceneTree& scene, std::span<const std::uint32_t> labels) {
  Raster raster{scene.width, scene.height, 1, 16, {}};
  for (const std::uint32_t label : labels) {
    if (label > UINT16_MAX) {
      throw Error(ErrorKind::bad_data,
                  fmt::format("{}: a PNG holds labels up to 65535, found {}; use "
                              ".npy",
                              mark(Setting::labels), label));
    }
    raster.samples.push_back(static_cast<std::uint16_t>(label));
  }
  return raster;
}

}  // namespace

std::string label_bytes(const SceneTree& scene, std::span<const std::uint32_t> labels,
                        LabelFormat format) {
  if (format == LabelFormat::csv) {
    std::string text;
    for (const std::uint32_t label : labels)
      fmt::format_to(std::back_inserter(text), "{}\n", label);
    return text;
  }
  std::ostringstream out;
  out.exceptions(std::ios::badbit);  // otherwise the stream would hide a lack of memory
  if (format == LabelFormat::npy)
    write_npy(out, labels, scene.width, scene.height);
  else
    write_png(out, label_image(scene, labels));
  return std::move(out).str();
}

}  // namespace ph::segment
