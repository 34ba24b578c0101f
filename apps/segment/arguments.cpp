// SPDX-License-Identifier: MIT
#include "arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "batch_names.hpp"
#include "choices.hpp"
#include "numbers.hpp"
#include "option_scopes.hpp"
#include "ph/core/error.hpp"
#include "report/page_template.hpp"

namespace ph::segment {
namespace {

using app::add_value;

/// What --version --verbose adds.
constexpr std::string_view kBuiltIn =
    "methods     {}\n"
    "reads       pcd ply xyz csv pts npy png pgm tree\n"
    "writes      pcd ply npy csv png json svg tree\n";

/// A number that must be above zero (or, with `zero`, at least zero) and finite.
double length(std::string_view option, const std::string& text, bool zero = false) {
  const double value = app::parse_number(option, text);
  if (!(value > 0 || (zero && value == 0)) || value == kInfinity) {
    throw Error(ErrorKind::usage, fmt::format("{}: found {}, expected a finite length {} 0", option,
                                              text, zero ? "of at least" : "above"));
  }
  return value;
}

Box parse_box(std::string_view option, const std::string& text) {
  const std::vector<double> v = app::parse_numbers(option, text, 6);
  const Box box{{v[0], v[2], v[4]}, {v[1], v[3], v[5]}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.min[axis] <= box.max[axis]) continue;
    throw Error(ErrorKind::usage, fmt::format("{}: found {}…{} on axis {}, expected min <= max",
                                              option, box.min[axis], box.max[axis], "xyz"[axis]));
  }
  return box;
}

Vec3 parse_point(std::string_view option, const std::string& text) {
  const std::vector<double> v = app::parse_numbers(option, text, 3);
  for (const double x : v) {
    if (x == kInfinity || x == -kInfinity) {
      throw Error(ErrorKind::usage,
                  fmt::format("{}: found {}, expected finite coordinates", option, text));
    }
  }
  return {v[0], v[1], v[2]};
}

std::array<std::uint32_t, 2> parse_labels(std::string_view option, const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos)
    throw Error(ErrorKind::usage,
                fmt::format("{}: found {}, expected two labels: A,B", option, text));
  const auto label = [&](const std::string& word) {
    return static_cast<std::uint32_t>(app::parse_integer(option, word, 1, UINT32_MAX));
  };
  return {label(text.substr(0, comma)), label(text.substr(comma + 1))};
}

bool parse_switch(std::string_view option, const std::string& text) {
  static constexpr std::array<std::string_view, 2> choices = {"off", "on"};
  return app::choose(option, text, choices) == 1;
}

Method parse_method(const std::string& text) {
  return static_cast<Method>(app::choose("--method", text, kMethodNames));
}

/// "0.005, paper: 0.01".
template <class Value>
std::string defaults_of(Value value_of) {
  return fmt::format("{}, paper: {}", (SegmentOptions{}.*value_of)(),
                     (SegmentOptions{.method = Method::paper}.*value_of)());
}

int parse_steps(const std::string& text) {
  if (text == "exact") return 0;
  return static_cast<int>(app::parse_integer("--steps", text, 1, std::numeric_limits<int>::max()));
}

std::vector<std::string_view> names_of_presets() {
  std::vector<std::string_view> names;
  for (const CameraPreset& preset : camera_presets()) names.push_back(preset.name);
  return names;
}

void add_input_options(CLI::App& app, Arguments& a) {
  app.add_option(
      "INPUT", a.inputs,
      "point cloud: .pcd, .ply, .npy, or text: .xyz, .csv, .pts; a stored merge tree (see --tree); "
      "with --camera or --intrinsics a depth image: .png, .pgm or .npy; - is standard input. "
      "Several, or a folder, are a stream of frames: its outputs are folders (FOLDER/) or have a * "
      "for the frame's name, and --json gets one line a frame");
  app::add_path(app, "--frames-from", "LIST",
                "a stream of the files that LIST names, one a line; -: standard input, each as "
                "soon as it is named",
                a.frames_from);
  app.add_flag("--stable-labels", a.stable_labels,
               "stream: an object keeps its label from frame to frame, by overlap in the image; "
               "clouds without rows and columns are compared in cubes of 1 cm. Labels are then not "
               "in the order of size");
  app::add_path(app, "--depth", "D.png",
                "depth image in place of INPUT: .png, .pgm or .npy; 0 and NaN are holes",
                a.image.depth);
  app::add_path(app, "--color,--colour", "C.png", "colour image of the same size", a.image.colour);
  CLI::Option* intrinsics = add_value(
      app, "--intrinsics", "FX,FY,CX,CY",
      "focal lengths and principal point of the depth image, pixels", [&a](const std::string& v) {
        const auto k = app::parse_numbers("--intrinsics", v, 4);
        a.image.camera = Camera{{k[0], k[1], k[2], k[3]}};
      });
  app::add_path(app, "--camera", "FILE|NAME",
                fmt::format("the camera of the depth image in place of --intrinsics: a camera_info "
                            "YAML of ROS, with its lens, an intrinsic JSON of Open3D, or the "
                            "nominal values of {}",
                            fmt::join(names_of_presets(), ", ")),
                a.image.calibration)
      ->excludes(intrinsics);
  add_value(app, "--depth-scale", "S",
            "depth units a metre (default: 1000, millimetres; floats: 1, metres)",
            [&a](const std::string& v) { a.image.scale = length("--depth-scale", v); });
  app.add_flag("--allow-empty", a.allow_empty,
               "a cloud without points is an empty result (default: an error)");
}

/// A number of at least 0.
double at_least_zero(std::string_view option, const std::string& text) {
  const double value = app::parse_number(option, text);
  if (!(value >= 0))
    throw Error(ErrorKind::usage, fmt::format("{}: found {}, expected at least 0", option, text));
  return value;
}

/// Options that others contradict. Not asked for by name: that ends the program if there is no
/// memory for a copy of the name.
struct Known {
  CLI::Option *method = nullptr, *supervoxels = nullptr, *min_persistence = nullptr,
              *plot_view = nullptr;
};

/// What comes before the plane is gone.
void add_scene_options(CLI::App& app, SegmentOptions& o) {
  const SegmentOptions d;
  add_value(app, "--max-range", "M",
            fmt::format("keep points up to M metres from the viewpoint; inf: all (default: {})",
                        d.max_range),
            [&o](const std::string& v) {
              o.max_range = app::parse_number("--max-range", v);
              if (o.max_range < 0) length("--max-range", v, true);
            });
  add_value(app, "--crop", "XMIN,XMAX,YMIN,YMAX,ZMIN,ZMAX",
            "keep points inside this box, metres; inf and -inf: no limit (default: all)",
            [&o](const std::string& v) { o.crop = parse_box("--crop", v); });
  add_value(app, "--plane", "on|off",
            "remove the supporting plane and what lies behind it (default: on)",
            [&o](const std::string& v) { o.plane = parse_switch("--plane", v); });
  add_value(app, "--plane-distance", "M",
            fmt::format("half the thickness of the plane, metres (default: {})",
                        defaults_of(&SegmentOptions::plane_margin)),
            [&o](const std::string& v) { o.plane_distance = length("--plane-distance", v); });
  add_value(app, "--plane-noise", "M",
            fmt::format("surface, supervoxels: least half thickness of the plane at a range of one "
                        "metre, metres; it grows with the square of the range. A --plane-distance "
                        "below it replaces it; 0: --plane-distance alone counts (default: {})",
                        d.plane_noise),
            [&o](const std::string& v) { o.plane_noise = length("--plane-noise", v, true); });
  add_value(app, "--viewpoint", "X,Y,Z",
            "where the sensor stood, metres (default: the file's VIEWPOINT, else 0,0,0; of an "
            "organised cloud whose pixels' rays meet elsewhere that place, with a note)",
            [&o](const std::string& v) { o.viewpoint = parse_point("--viewpoint", v); });
}

Known add_method_options(CLI::App& app, SegmentOptions& o) {
  const SegmentOptions d;
  Known known;
  known.method = add_value(
      app, "--method", "NAME",
      "surface: by the shape of the visible surface (default); paper: by distance alone, the "
      "pipeline of the ICRA 2016 paper; supervoxels: see --supervoxels",
      [&o](const std::string& v) { o.method = parse_method(v); });
  known.supervoxels = add_value(
      app, "--supervoxels", "M",
      fmt::format("method supervoxels, with seeds so far apart that the surface is nowhere more "
                  "than M metres from one; no less than a voxel (default: {})",
                  d.spacing),
      [&o](const std::string& v) { o.spacing = length("--supervoxels", v); });
  add_value(app, "--voxel", "M",
            fmt::format("edge of a voxel, metres (default: {})",
                        defaults_of(&SegmentOptions::voxel_size)),
            [&o](const std::string& v) { o.voxel = length("--voxel", v); });
  known.min_persistence = add_value(
      app, "--min-persistence", "X",
      fmt::format("least persistence of a part; one of less joins the neighbour that it meets "
                  "first. surface: a mean concavity from 0 to 2 (default: {}); supervoxels: metres "
                  "(default: {})",
                  d.cut().value, SegmentOptions{.method = Method::supervoxels}.cut().value),
      [&o](const std::string& v) { o.min_persistence = at_least_zero("--min-persistence", v); });
  add_value(
      app, "--distance", "M",
      fmt::format("paper: maximum distance of the Vietoris-Rips complex, metres (default: {})",
                  d.distance),
      [&o](const std::string& v) { o.distance = length("--distance", v, true); });
  add_value(app, "--steps", "N|exact",
            fmt::format("paper: filtration steps up to the distance; exact: as many as there are "
                        "distances (default: {})",
                        d.steps),
            [&o](const std::string& v) { o.steps = parse_steps(v); });
  app.add_flag_callback(
      "--no-check", [&o] { o.check = false; },
      "skip the cross-check of union-find against boundary-matrix reduction "
      "(on by default; a difference exits 1)");
  return known;
}

/// What a stored tree follows, too. Contradictions are refused.
void add_cut_options(CLI::App& app, CutArguments& cut, const Known& known) {
  const CutOptions d, supervoxels = SegmentOptions{.method = Method::supervoxels}.cut();
  add_value(app, "--cut", "X",
            "cut the merge tree here: the same as --min-persistence; paper: segments are "
            "the components at X metres, at most --distance (default: as the tree was cut)",
            [&cut](const std::string& v) { cut.value = at_least_zero("--cut", v); })
      ->excludes(known.min_persistence);
  add_value(
      app, "--min-part", "N",
      fmt::format("fewest voxels of a part; a smaller one joins the neighbour that it meets first "
                  "(default: {}; supervoxels: {})",
                  d.min_part, supervoxels.min_part),
      [&cut](const std::string& v) { cut.min_part = app::parse_integer("--min-part", v, 1); });
  add_value(
      app, "--min-size", "N",
      fmt::format("fewest voxels of a segment (default: {}; supervoxels: {})", d.min_size,
                  supervoxels.min_size),
      [&cut](const std::string& v) { cut.min_size = app::parse_integer("--min-size", v, 1); });
  CLI::Option* objects = app.add_flag_callback(
      "--objects", [&cut] { cut.objects = true; },
      "surface: join the visible parts of an object, over a rim or behind what hides its middle "
      "(default)");
  app.add_flag_callback(
         "--parts", [&cut] { cut.objects = false; }, "surface: leave each visible part a segment")
      ->excludes(objects);
}

constexpr std::array<std::string_view, 5> kPlotKinds = {"barcode", "diagram", "betti", "tree",
                                                        "cloud"};

ViewTurn parse_turn(std::string_view option, const std::string& text) {
  const std::vector<double> v = app::parse_numbers(option, text, 2);
  if (!(v[0] >= -360 && v[0] <= 360 && v[1] >= -90 && v[1] <= 90))
    throw Error(ErrorKind::usage,
                fmt::format("{}: found {}, expected degrees to the right from -360 to 360 and up "
                            "from -90 to 90",
                            option, text));
  return {v[0], v[1]};
}

void add_output_options(CLI::App& app, Arguments& a, app::PlotArguments& plots, Known& known) {
  OutputPaths& files = a.files;
  const auto path = [&app](const std::string& names, const std::string& placeholder,
                           const std::string& what, std::string& target) {
    app::add_path(app, names, placeholder, what, target);
  };
  path("-o,--output", "FILE.pcd|.ply",
       "the same points in the same order with all their fields and `label` (an existing `label` "
       "becomes `label_in`)",
       files.output);
  path("--labels", "FILE.npy|.csv|.png",
       "one label a point: 0 no segment, 1…k by decreasing number of points (csv: one a line; "
       "png: 16 bits, organised clouds)",
       files.labels);
  path("--json", "FILE", "summary: stages, complex, plane, segments", files.json);
  app.add_flag("--signatures", a.signatures,
               "JSON: H0, H1 and H2 of the shape of each segment (a handle is a loop, a hollow a "
               "bar in dimension 2), in metres");
  path("--tree", "FILE.tree|.json",
       "the merge tree and what other cuts need: .tree is an INPUT for --cut and --explain, .json "
       "is for other programs",
       files.tree);
  path("--barcode", "FILE", "barcode of H0: .csv, .json, .txt, .pers, .dipha, .npy", files.barcode);
  app::add_plot_options(
      app, kPlotKinds,
      "figure of the barcode, of the merge tree, or of the cloud with a colour a segment "
      "(repeatable)",
      "Options", plots);
  known.plot_view = add_value(
      app, "--plot-view", "RIGHT,UP",
      "where a plot of the cloud is seen from: by how much the eye goes around the segments "
      "from the viewpoint, degrees (default: 0,0)",
      [&a](const std::string& v) { a.plot_view = parse_turn("--plot-view", v); });
  path("--coloured,--colored", "FILE.pcd|.ply",
       "the points with a colour a segment, safe for the colour-blind, and the rest in grey",
       files.coloured);
  add_value(app, "--explain", "A,B",
            "print where, and at which value of the filtration, the segments A and B join, in "
            "place of the table",
            [&a](const std::string& v) { a.explain = parse_labels("--explain", v); });
  path("--picture", "FILE.png", "the image with its segments coloured (organised clouds)",
       files.picture);
  path("--report", "FILE.html",
       "one page to look at: cloud, segments, merge tree and barcode, linked, with a slider that "
       "cuts anew; needs no network",
       files.report);
}

/// What makes the scene, for a command that cuts it elsewhere.
std::vector<std::string> scene_options(const CLI::App& app) {
  constexpr std::array<std::string_view, 22> other = {
      "output",      "labels",        "json",      "signatures", "tree",
      "barcode",     "plot",          "coloured",  "explain",    "picture",
      "report",      "cut",           "objects",   "parts",      "min-persistence",
      "frames-from", "stable-labels", "plot-kind", "plot-view",  "title",
      "size",        "axis"};
  return app::given_options(app, other);
}

/// Whether an input is a depth image, by its name, where a camera is given.
bool may_be_image(const std::string& path) {
  constexpr std::array<std::string_view, 6> extensions = {".png", ".PNG", ".pgm",
                                                          ".PGM", ".npy", ".NPY"};
  return std::ranges::any_of(extensions, [&](auto e) { return path.ends_with(e); });
}
/// Without one, an array of NumPy is a cloud.
bool must_be_image(const std::string& path) {
  return may_be_image(path) && !path.ends_with(".npy") && !path.ends_with(".NPY");
}

void require_inputs(const Arguments& a) {
  const bool depth = !a.image.depth.empty(), several = a.is_stream();
  const auto reject = [](const std::string& what) { throw Error(ErrorKind::usage, what); };
  if (a.inputs.empty() && a.frames_from.empty() && !depth)
    reject("expected INPUT or --depth; see --help");
  if (!a.frames_from.empty() && depth) reject("--frames-from: found --depth beside it");
  if (!a.inputs.empty() && depth) reject("found both INPUT and --depth, expected one of them");
  for (const std::string& input : a.inputs) {
    if (input.empty()) reject("INPUT: found '', expected a path");
    if (must_be_image(input) && !a.image.has_camera())
      reject(fmt::format("{}: expected --camera or --intrinsics FX,FY,CX,CY with a depth image",
                         printable(input)));
  }
  if (std::ranges::count(a.inputs, "-") + (a.frames_from == "-") > 1)
    reject("INPUT: standard input can be read once only");
  if (several && depth) reject("--depth: several frames need INPUT, a folder or --frames-from");
  if (a.signatures && a.files.json.empty()) reject("--signatures: expected --json with it");
  if (several && a.explain) reject("--explain takes one input only");
  if (!several && a.stable_labels) reject("--stable-labels: expected several frames");
}

void require_consistent(const Arguments& a) {
  require_inputs(a);
  const bool depth = !a.image.depth.empty();
  if (depth && !a.image.has_camera()) {
    throw Error(ErrorKind::usage, "--depth: expected --camera or --intrinsics FX,FY,CX,CY with it");
  }
  if (a.explain && a.files.to_standard_output()) {
    throw Error(ErrorKind::usage, "--explain and a result that goes to standard output, too");
  }
  if (!depth && !a.image.colour.empty()) {
    throw Error(ErrorKind::usage, "--color: expected --depth with it");
  }
  if (!depth && !a.is_stream() && !may_be_image(a.inputs.front())) {
    if (a.image.has_camera())
      throw Error(ErrorKind::usage, fmt::format("{}: expected a depth image, found a cloud",
                                                a.image.camera ? "--intrinsics" : "--camera"));
  }
}

}  // namespace

std::optional<std::string> parse_arguments(int argc, const char* const* argv, Arguments& a) {
  CLI::App app("Segments a point cloud or a depth image by zero-dimensional persistent homology.",
               "ph-segment");
  add_input_options(app, a);
  add_scene_options(app, a.options);
  Known known = add_method_options(app, a.options);
  add_cut_options(app, a.cut, known);
  app::PlotArguments plots;
  add_output_options(app, a, plots, known);
  app::add_common_options(app, a.common);
  if (auto answer = app::parse_command_line(app, a.common, argc, argv,
                                            fmt::format(kBuiltIn, fmt::join(kMethodNames, " "))))
    return answer;
  if (known.supervoxels->count() > 0) {
    if (known.method->count() > 0 && a.options.method != Method::supervoxels) {
      throw Error(ErrorKind::usage,
                  fmt::format("--supervoxels: found --method {}, expected supervoxels or none",
                              kMethodNames[static_cast<std::size_t>(a.options.method)]));
    }
    a.options.method = Method::supervoxels;
  }
  a.given = app::given_scopes(app, option_scopes());
  require_plane(a.given, a.options.plane);
  a.files.plots = plots.together(kPlotKinds.front());
  a.files.look = plots.look;
  const bool shows_cloud = std::ranges::count(a.files.plots, "cloud", &app::Plot::kind) > 0;
  if (known.plot_view->count() > 0 && !shows_cloud)
    throw Error(ErrorKind::usage, "--plot-view needs --plot FILE --plot-kind cloud");
  if (!a.files.report.empty()) {
    report::require_built_in("--report");
    a.command = app::typed_command("ph-segment", argc, argv);
    a.scene_options = scene_options(app);
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
  const std::vector<std::string> outputs = files.of_each_frame();
  if (std::ranges::any_of(outputs, [](const auto& path) { return path.ends_with('/'); }))
    return true;
  // A folder is one only if its results have a place; else it is an input that cannot be read.
  const auto takes_several = [](const std::string& path) {
    return path.find('*') != path.npos || app::is_folder(path);
  };
  return files.any() && !inputs.empty() && app::is_folder(inputs.front()) &&
         std::ranges::all_of(outputs, takes_several);
}

bool Arguments::is_depth_image() const {
  return !image.depth.empty() || (image.has_camera() && may_be_image(input));
}

}  // namespace ph::segment
