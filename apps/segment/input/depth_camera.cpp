// SPDX-License-Identifier: MIT
#include "segment/input/depth_camera.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <vector>

#include "common/arguments/choices.hpp"
#include "ph/error.hpp"

namespace ph::segment {

void load_camera(DepthInput& image, app::Session& session) {
  if (image.calibration.empty()) return;
  const auto presets = camera_presets();
  const auto preset = std::ranges::find(presets, image.calibration, &CameraPreset::name);
  if (preset != presets.end()) {
    image.camera = preset->camera;
    session.note(
        fmt::format("--camera {}: nominal values for {}; each camera differs by some per cent, "
                    "other images by more; its calibration is better",
                    preset->name, preset->images));
    return;
  }
  if (!std::filesystem::exists(image.calibration)) {
    std::vector<std::string_view> names;
    for (const CameraPreset& known : presets) names.push_back(known.name);
    const auto near = app::nearest_name(image.calibration, names);
    throw Error(ErrorKind::no_input,
                fmt::format("--camera: found '{}', expected a file that is there or one of {}{}",
                            printable(image.calibration), fmt::join(names, ", "),
                            near ? fmt::format("; did you mean '{}'?", *near) : ""));
  }
  image.camera = read_camera(image.calibration, &session.context());
  if (image.camera->lens.model != Lens::Model::none) {
    session.note(
        fmt::format("--camera {}: the depth image is taken for a raw one, and the bending "
                    "of its lens is undone",
                    printable(image.calibration)));
  }
}

Camera camera_for(const DepthInput& image, Index width, Index height, app::Session& session) {
  const Camera& camera = *image.camera;
  Camera result;
  try {
    result = camera.scaled_to(width, height);
  } catch (const Error& error) {
    std::string_view what = error.what();
    if (what.starts_with("camera: ")) what.remove_prefix(8);
    throw Error(error.kind(), fmt::format("--camera {}: {}", printable(image.calibration), what));
  }
  if (camera.width != 0 && (camera.width != width || camera.height != height)) {
    const Intrinsics& k = result.intrinsics;
    session.note(
        fmt::format("--camera {}: calibrated for {} x {} pixels; for {} x {} it is scaled to "
                    "--intrinsics {:.6g},{:.6g},{:.6g},{:.6g}",
                    printable(image.calibration), camera.width, camera.height, width, height, k.fx,
                    k.fy, k.cx, k.cy));
  }
  return result;
}

}  // namespace ph::segment
