// SPDX-License-Identifier: MIT
#include "apps/segment/input/frames.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <string_view>
#include <vector>

#include "apps/common/values/choices.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/segment/depth_scene.hpp"
#include "ph/error.hpp"

namespace ph::segment {

void load_camera(DepthInput& image, app::Session& session) {
  if (image.calibration.empty()) return;
  const Note note = [&session](const Message& text) { session.note(text); };
  image.camera = camera_named(image.calibration, note);
  if (image.camera) return;
  if (!std::filesystem::exists(files::path_of(image.calibration))) {
    std::vector<std::string_view> names;
    for (const CameraPreset& known : camera_presets()) names.push_back(known.name);
    const auto near = app::nearest_name(image.calibration, names);
    const bool may_be_numbers =
        image.calibration.find_first_not_of("0123456789.,+-eE ") == std::string::npos;
    throw Error(ErrorKind::no_input,
                fmt::format("--camera: found '{}', expected an existing file or one of {}{}",
                            printable(image.calibration), fmt::join(names, ", "),
                            near             ? fmt::format("; did you mean '{}'?", *near)
                            : may_be_numbers ? "; --intrinsics takes numbers"
                                             : ""));
  }
  image.camera = calibrated_camera(image.calibration, note, session.context());
}

}  // namespace ph::segment
