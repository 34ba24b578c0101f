// SPDX-License-Identifier: MIT
#include "apps/segment/arguments/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <string_view>

#include "apps/common/files/batch_names.hpp"
#include "apps/common/values/numbers.hpp"
#include "apps/segment/arguments/argument_groups.hpp"
#include "apps/segment/arguments/scopes.hpp"
#include "ph/detail/report/page_template.hpp"
#include "ph/error.hpp"

namespace ph::segment {
namespace {

std::vector<std::string_view> names_of_presets() {
  std::vector<std::string_view> names;
  for (const CameraPreset& preset : camera_presets()) names.push_back(preset.name);
  return names;
}

/// The number of units per metre in the pixels of a depth image.
double depth_scale(const std::string& text) {
  const double scale = length("--depth-scale", text);
  if (scale < 1)
    throw Error(ErrorKind::usage,
                fmt::format("--depth-scale: found {0}, expected units per metre, at least 1; if a "
                            "unit is {0} m, the scale is {1:.6g}",
                            text, 1 / scale));
  return scale;
}

void add_input_options(app::Options& options, Arguments& a) {
  options.topic("input");
  options.inputs(
      "INPUT",
      "point cloud: .pcd, .ply, .npy, or text: .xyz, .csv, .pts; a stored merge tree (see --tree); "
      "with --camera or --intrinsics a depth image: .png, .pgm or .npy; - is standard input. "
      "Several, or a folder, are a stream of frames: its outputs are folders (FOLDER/) or have a * "
      "for the frame's name, and --json gets one line per frame",
      a.inputs);
  options.path("--depth", "FILE.png|.pgm|.npy",
               "depth image in place of INPUT; 0 and NaN are holes", a.image.depth);
  options.path({"--color,--colour", kOfDepth}, "FILE.png", "colour image of the same size",
               a.image.colour);
  CLI::Option* intrinsics = options.value(
      {"--intrinsics", kOfDepth}, "FX,FY,CX,CY",
      "focal lengths and principal point of the depth image, pixels", [&a](const std::string& v) {
        const auto k = app::parse_numbers("--intrinsics", v, 4,
                                          "--camera takes a file or the name of a camera");
        a.image.camera = Camera{{k[0], k[1], k[2], k[3]}};
      });
  CLI::Option* camera = options.path(
      {"--camera", kOfDepth}, fmt::format("FILE|{}", fmt::join(names_of_presets(), "|")),
      "the camera of the depth image: a camera_info YAML of ROS, with its lens; a YAML of OpenCV; "
      "a JSON of Open3D, RealSense or BOP; the nine numbers of a camera matrix; or the nominal "
      "values of a model",
      a.image.calibration);
  camera->excludes(intrinsics);
  options.value(
      {"--depth-scale", kOfScenes}, "S",
      "units per metre of a depth image (default: 1000, millimetres; floats: 1, metres) or "
      "of the coordinates of a cloud (default: 1)",
      [&a](const std::string& v) { a.image.scale = depth_scale(v); });
  options.flag({"--allow-empty", {kCloud | kAnyMethod | kAnyPlane, "clouds"}},
               "a cloud without points is an empty result (default: an error)", a.allow_empty);
  options.topic("streams");
  options.path("--frames-from", "FILE",
               "a stream of the files that FILE names, one per line; -: standard input, each as "
               "soon as it is named",
               a.frames_from);
  options.flag("--stable-labels",
               "an object keeps its label from frame to frame, by overlap in the image; clouds "
               "without rows and columns are compared in cubes of 1 cm. Labels are then not in the "
               "order of size",
               a.stable_labels);
}

/// True if a depth image may have this file name. A camera must then be given as well.
bool may_be_image(const std::string& path) {
  constexpr std::array<std::string_view, 6> extensions = {".png", ".PNG", ".pgm",
                                                          ".PGM", ".npy", ".NPY"};
  return std::ranges::any_of(extensions, [&](auto e) { return path.ends_with(e); });
}
/// True if only a depth image has this file name. A NumPy array without a camera is a cloud.
bool must_be_image(const std::string& path) {
  return may_be_image(path) && !path.ends_with(".npy") && !path.ends_with(".NPY");
}

void require_inputs(const Arguments& a) {
  const bool depth = !a.image.depth.empty(), several = a.is_stream();
  const auto reject = [](const std::string& what) { throw Error(ErrorKind::usage, what); };
  if (a.inputs.empty() && a.frames_from.empty() && !depth)
    reject("expected INPUT, --frames-from or --depth; see --help");
  if (!a.frames_from.empty() && depth)
    reject("--frames-from: found --depth as well, expected one of them");
  if (!a.inputs.empty() && depth) reject("found both INPUT and --depth, expected one of them");
  for (const std::string& input : a.inputs) {
    if (input.empty()) reject("INPUT: found '', expected a path");
    if (must_be_image(input) && !a.image.has_camera())
      reject(fmt::format(
          "{}: found a depth image without a camera, expected --camera or --intrinsics FX,FY,CX,CY",
          printable(input)));
  }
  if (std::ranges::count(a.inputs, "-") + (a.frames_from == "-") > 1)
    reject("INPUT: standard input can be read once only");
  if (several && depth)
    reject(
        "--depth: found an output for several frames, expected a file for one frame; INPUT and "
        "--frames-from accept several depth images");
  if (a.signatures && a.files.json.empty()) reject("--signatures: needs --json");
  if (several && a.explain)
    reject("--explain: found several inputs or an output for several, expected one of each");
  if (!several && a.stable_labels) reject("--stable-labels: found one frame, expected several");
}

void require_consistent(const Arguments& a) {
  require_inputs(a);
  const bool depth = !a.image.depth.empty();
  if (depth && !a.image.has_camera()) {
    throw Error(ErrorKind::usage,
                "--depth: found no camera, expected --camera or --intrinsics FX,FY,CX,CY");
  }
  if (a.explain && a.files.to_standard_output()) {
    const std::vector<app::Written> outputs = a.files.written();
    throw Error(
        ErrorKind::usage,
        fmt::format("--explain: standard output already has the result of {0}; use {0} FILE",
                    std::ranges::find(outputs, "-", &app::Written::path)->option));
  }
  if (!depth && !a.image.colour.empty()) {
    throw Error(ErrorKind::usage, "--color: needs --depth");
  }
  if (!depth && !a.is_stream() && app::is_folder(a.inputs.front()))
    throw Error(
        ErrorKind::no_input,
        fmt::format("{}: it is a directory, which is a stream of frames; give an output for "
                    "each of them, such as -o FOLDER/, or --json FILE with a line per frame",
                    printable(a.inputs.front())));
  if (!depth && !a.is_stream() && !may_be_image(a.inputs.front())) {
    if (a.image.has_camera())
      throw Error(
          ErrorKind::usage,
          fmt::format("{}: found {}, expected a depth image, .png, .pgm or .npy; --depth "
                      "takes a file of any name",
                      a.image.camera ? "--intrinsics" : "--camera", printable(a.inputs.front())));
  }
}

}  // namespace

std::optional<std::string> parse_arguments(int argc, const char* const* argv, Arguments& a) {
  CLI::App cli("", std::string(manual().program));
  app::Options options(cli);
  add_input_options(options, a);
  add_scene_options(options, a.options);
  Known known = add_method_options(options, a.options);
  add_cut_options(options, a.cut, known);
  app::PlotArguments plots;
  add_output_options(options, a, plots, known);
  app::add_common_options(options, a.common);
  if (auto answer = app::parse_command_line(options, a.common, argc, argv, manual())) return answer;
  if (known.supervoxels->count() > 0) {
    if (known.method->count() > 0 && a.options.method != Method::supervoxels) {
      throw Error(
          ErrorKind::usage,
          fmt::format(
              "--supervoxels: found --method {}, expected --method supervoxels or no --method",
              kMethodNames[static_cast<std::size_t>(a.options.method)]));
    }
    a.options.method = Method::supervoxels;
  }
  a.given = options.given();
  require_plane(a.given, a.options.plane);
  if (a.options.most_supports != SegmentOptions().most_supports &&
      a.options.method != Method::surface)
    throw Error(ErrorKind::usage,
                fmt::format("--plane {}: found --method {}, expected --method surface",
                            a.options.most_supports,
                            kMethodNames[static_cast<std::size_t>(a.options.method)]));
  take_plots(a, plots, known);
  if (!a.files.report.empty()) {
    report::require_built_in();
    a.command = app::typed_command("ph-segment", argc, argv);
    a.scene_options = scene_options(options);
  }
  a.options.min_part = a.cut.min_part;
  a.options.min_size = a.cut.min_size;
  a.options.objects = a.cut.objects.value_or(a.options.objects);
  require_consistent(a);
  if (!a.is_stream() && !a.inputs.empty()) a.input = a.inputs.front();
  return std::nullopt;
}

bool Arguments::is_stream() const {
  if (!frames_from.empty() || inputs.size() > 1) return true;
  const std::vector<app::Written> outputs = files.of_each_frame();
  const auto names_frames = [](const app::Written& output) { return app::names_each(output.path); };
  if (std::ranges::any_of(outputs, names_frames)) return true;
  // A folder is accepted only if there is a place for its results. Otherwise it is an input that
  // cannot be read.
  return files.any() && !inputs.empty() && app::is_folder(inputs.front()) &&
         std::ranges::all_of(outputs, app::is_folder, &app::Written::path);
}

bool Arguments::is_depth_image() const {
  return !image.depth.empty() || (image.has_camera() && may_be_image(input));
}

std::string DepthInput::calibration_file() const {
  return std::ranges::count(camera_presets(), calibration, &CameraPreset::name) > 0 ? ""
                                                                                    : calibration;
}

app::InputFiles inputs_of(const Arguments& a) {
  app::InputFiles files;
  for (const std::string& path : a.inputs) files.add(path);
  // mutant: file-camera
  for (const std::string& path :
       {a.frames_from, a.image.depth, a.image.colour, a.image.calibration_file()})
    files.add(path);
  return files;
}

}  // namespace ph::segment
