// SPDX-License-Identifier: MIT
#include "ph/detail/segment/depth_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "ph/error.hpp"

namespace ph::segment {
namespace {

/// The name of the camera as the user gave it, for a message.
std::string camera_mark(std::string_view calibration) {
  return mark(Setting::camera, printable(calibration));
}

/// Returns the camera for images of this size. Adds a note if its calibration has another size.
Camera scaled(const Camera& camera, std::string_view calibration, Index width, Index height,
              const Note& note) {
  Camera result;
  try {
    result = camera.scaled_to(width, height);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", camera_mark(calibration),
                                          error.message().without_place().marked()));
  }
  if (camera.width != 0 && (camera.width != width || camera.height != height)) {
    const Intrinsics& k = result.intrinsics;
    note(fmt::format("{}: calibrated for {} x {} pixels; for {} x {} it is scaled to {}",
                     camera_mark(calibration), camera.width, camera.height, width, height,
                     mark(Setting::intrinsics,
                          fmt::format("{:.6g},{:.6g},{:.6g},{:.6g}", k.fx, k.fy, k.cx, k.cy))));
  }
  return result;
}

/// True if all depths are numbers that fit into 8 bits, and some are above 0. In a picture of the
/// depth, such numbers stand for grey. In millimetres, no camera sees so near only.
bool fits_into_bytes(const Voxels& depth) {
  constexpr double most = std::numeric_limits<std::uint8_t>::max();
  bool any = false;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (depth[i] > most && std::isfinite(depth[i])) return false;
    any |= depth[i] > 0;
  }
  return any;
}

}  // namespace

std::optional<Camera> camera_named(std::string_view name, const Note& note) {
  const auto presets = camera_presets();
  const auto preset = std::ranges::find(presets, name, &CameraPreset::name);
  if (preset == presets.end()) return std::nullopt;
  note(
      fmt::format("{}: nominal values for {}; individual cameras differ by a few per cent, "
                  "other image sizes by more; a calibration is better",
                  camera_mark(preset->name), preset->images));
  return preset->camera;
}

Camera calibrated_camera(const std::string& path, const Note& note, const RunContext& context) {
  Camera camera = read_camera(path, &context);
  if (camera.lens.model != Lens::Model::none) {
    note(
        fmt::format("{}: the depth image is assumed to be raw, and the distortion of the lens is "
                    "corrected",
                    camera_mark(path)));
  }
  return camera;
}

Cloud cloud_of_depth(const DepthImage& image, const std::optional<Raster>& colour,
                     const Camera& camera, std::string_view calibration,
                     std::optional<double> given, const Note& note) {
  const Index rows = image.depth.extents[0], columns = image.depth.extents[1];
  const Camera fitting = scaled(camera, calibration, columns, rows, note);
  std::optional<double> scale = given;
  // Images of floats are in metres, regardless of the camera's unit.
  if (!scale && camera.depth_scale > 0 && image.scale != 1) {
    scale = camera.depth_scale;
    note(fmt::format("{}: its depth_scale is used: {:.6g} units per metre",
                     camera_mark(calibration), *scale));
  }
  if (!given && image.scale != 1 && fits_into_bytes(image.depth.values))
    note(Message::guess(fmt::format(
        "no depth is above 255, as in a picture of the depth with 8 bits; {} states how "
        "many units a metre has",
        mark(Setting::depth_scale))));
  DepthCounts counts;
  Cloud cloud =
      cloud_from_depth(image.depth, colour, fitting, scale.value_or(image.scale), &counts);
  if (counts.negative > 0)
    note(fmt::format("pixels with a depth below 0, which count as holes: {}", counts.negative));
  if (counts.unseen > 0) {
    note(fmt::format("pixels without a ray through the camera's lens, which count as holes: {}",
                     counts.unseen));
  }
  return cloud;
}

}  // namespace ph::segment
