// SPDX-License-Identifier: MIT
#include "apps/segment/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <optional>
#include <span>

#include "apps/common/terminal/build_information.hpp"
#include "apps/common/terminal/exit_code.hpp"
#include "apps/common/terminal/words.hpp"
#include "apps/segment/arguments/arguments.hpp"
#include "apps/segment/arguments/scopes.hpp"
#include "apps/segment/input/frames.hpp"
#include "apps/segment/output/outputs.hpp"
#include "apps/segment/output/summary.hpp"
#include "ph/detail/core/files.hpp"
#include "ph/detail/io/output_file.hpp"
#include "ph/detail/report/sha256.hpp"
#include "ph/detail/segment/cloud_files.hpp"
#include "ph/detail/segment/depth_scene.hpp"
#include "ph/detail/segment/notes.hpp"
#include "ph/detail/segment/tree_barcode.hpp"
#include "ph/error.hpp"

namespace ph::segment {
namespace {

Note note_of(app::Session& session) {
  return [&session](const Message& text) { session.note(text); };
}

Cloud read_depth_image(const Input& input, const DepthInput& image, app::Session& session) {
  const RunContext& context = session.context();
  const DepthImage depth = read_depth(input, {.context = &context});
  std::optional<Raster> colour;
  if (!image.colour.empty()) colour = read_png(image.colour, &context);
  return cloud_of_depth(depth, colour, *image.camera, image.calibration, image.scale,
                        note_of(session));
}

Cloud read_points(const Input& input, const Arguments& arguments, app::Session& session) {
  ReadOptions options;
  options.context = &session.context();
  options.allow_empty = arguments.allow_empty;
  options.note = note_of(session);
  Cloud cloud = ph::read_cloud(input, options);
  if (arguments.image.scale) cloud.to_metres(*arguments.image.scale);
  return cloud;
}

/// True if the answer is a text on standard output.
bool prints(const Arguments& a) { return a.explain || !a.files.any(); }

/// Checks that no output replaces an input. @throws Error (usage).
void require_separate(const Arguments& a, app::Session& session) {
  std::vector<app::Written> outputs = a.files.written();
  // mutant: file-table
  if (prints(a)) outputs.push_back({a.explain ? "--explain" : "the table", "-"});
  if (!app::require_separate(inputs_of(a), outputs, a.common.force) && a.common.force)
    session.explain("--force: not needed, because no output is an input");
}

/// Segments the cloud. If memory does not suffice, the error also names the options that help,
/// because only the program knows these options.
Segmentation segment_within_limits(const Cloud& cloud, const SegmentOptions& options,
                                   const RunContext& context) {
  try {
    return segment(cloud, options, context);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::resource) throw;
    const std::string edges =
        options.method == Method::paper ? mark(Setting::distance) + " or " : "";
    throw Error(
        ErrorKind::resource,
        fmt::format("{}; lower {}{}, enlarge {}, or raise {}", error.marked(), edges,
                    mark(Setting::max_range), mark(Setting::voxel), mark(Setting::memory_limit)));
  }
}

/// Cuts the stored tree again.
void cut_again(Segmentation& s, const CutOptions& options, const RunContext& context) {
  s.cut = cut(s.tree, options, context);
  s.tree.first_cut = options;
}

Segmentation cut_of_tree(const Input& input, const Arguments& arguments,
                         const RunContext& context) {
  Segmentation s;
  s.tree = read_tree(input);
  require_input(arguments.given, kStoredTree);
  require_method(arguments.given, s.tree.method);
  if (!s.tree.plane) s.plane_note = "the tree was made without a plane";
  s.barcode = barcode_of(s.tree.merge_tree);
  const auto start = std::chrono::steady_clock::now();
  cut_again(s, arguments.cut.over(s.tree.first_cut), context);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  s.stages.push_back({"cut", s.tree.vertices.rows(), seconds.count()});
  return s;
}

/// The input as it was read, and the result.
struct Result {
  std::optional<Cloud> cloud;  ///< empty if a stored tree was read
  std::string sha256;          ///< the hash of the input, for a report
  Segmentation segmentation;
  double read_seconds = 0;
};

/// @param plane_guess the plane of the previous frame, if there was one.
Result result_of(const Arguments& arguments, const std::optional<Plane>& plane_guess,
                 const Outputs& outputs, app::Session& session) {
  const RunContext& context = session.context();
  Result result;
  const auto start = std::chrono::steady_clock::now();
  std::optional<app::BarHold> somebody_types;
  if (app::is_typed({arguments.input, arguments.image.depth, arguments.image.colour}))
    somebody_types.emplace(session);
  const DepthInput& image = arguments.image;
  std::optional<Input> input(
      Input::open(files::path_of(image.depth.empty() ? arguments.input : image.depth), &context,
                  Input::Excess::refused, [&](const Input& first) {
                    if (arguments.is_depth_image())
                      depth_start_check()(first);
                    else if (!is_tree(first))
                      cloud_start_check()(first);
                  }));
  const bool is_scene = arguments.is_depth_image() || !is_tree(*input);
  if (is_scene) require_input(arguments.given, arguments.is_depth_image() ? kDepthImage : kCloud);
  if (is_scene) require_method(arguments.given, arguments.options.method);
  if (arguments.is_depth_image())
    result.cloud = read_depth_image(*input, image, session);
  else if (is_scene)
    result.cloud = read_points(*input, arguments, session);
  if (!arguments.files.report.empty()) result.sha256 = report::sha256_hex(*input, context);
  somebody_types.reset();
  Segmentation& s = result.segmentation;
  const auto stop_reading = [&] {
    result.read_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  if (!result.cloud) {
    s = cut_of_tree(*input, arguments, context);
    stop_reading();
    result.read_seconds -= s.stages.front().seconds;
    outputs.require_suitable(s.tree.height);
    return result;
  }
  input.reset();
  stop_reading();
  if (arguments.allow_empty && result.cloud->size() > 0)
    session.explain("--allow-empty: not needed, because the cloud has points");
  outputs.require_suitable(result.cloud->height);
  SegmentOptions options = arguments.options;
  options.plane_guess = plane_guess;
  s = segment_within_limits(*result.cloud, options, context);
  const CutOptions asked = arguments.cut.over(s.tree.first_cut);
  if (asked != s.tree.first_cut) cut_again(s, asked, context);
  return result;
}

/// The signature of each segment. If memory does not suffice for a signature, it stays empty and a
/// note reports this. The other results are not lost.
std::vector<std::optional<Barcode>> signatures_of(const Segmentation& s, app::Session& session) {
  std::vector<std::optional<Barcode>> signatures(s.cut.segments.size());
  for (const Segment& g : s.cut.segments) {
    const auto note = [&](std::string_view why) {
      session.note(fmt::format("segment {}: no signature: {}", g.label, why));
    };
    try {
      signatures[g.label - 1] = signature(s.tree, s.cut, std::span(&g.label, 1), session.context());
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::resource) throw;
      note(error.marked());
    } catch (const std::bad_alloc&) {
      note("memory ran out");
    }
  }
  return signatures;
}

/// Prints the messages of --verbose about the stages.
void explain_stages(const Segmentation& s, const Arguments& arguments, app::Session& session) {
  for (const Stage& stage : s.stages) {
    session.explain(
        fmt::format("{:12} {:8} points {:9.3f} ms", stage.name, stage.points, 1e3 * stage.seconds));
  }
  const SegmentOptions& options = arguments.options;
  if (s.tree.method == options.method && !options.voxel && s.tree.voxel > options.voxel_size()) {
    session.explain(
        fmt::format("voxels of {:.4g} m instead of {} m: most points are too far apart for smaller "
                    "voxels to touch",
                    s.tree.voxel, options.voxel_size()));
  }
  if (!s.tree.plane) return;
  const auto& [normal, offset, share] = *s.tree.plane;
  session.explain(fmt::format(
      "plane {:.4f} x + {:.4f} y + {:.4f} z + {:.4f} = 0, {:.1f} % of the points in range",
      normal[0], normal[1], normal[2], offset, 100 * share));
}

std::vector<std::string> notes_on(const Result& result, const Arguments& arguments) {
  const Cloud* cloud = result.cloud ? &*result.cloud : nullptr;
  const DepthInput& image = arguments.image;
  std::optional<DepthSource> depth;
  if (cloud && arguments.is_depth_image())
    depth.emplace(DepthSource{*image.camera,
                              image.calibration.empty() ? Setting::intrinsics : Setting::camera});
  std::vector<std::string> texts;
  for (const Message& note :
       notes(result.segmentation, arguments.options, cloud, depth ? &*depth : nullptr))
    texts.push_back(note.in_words(app::kWords));
  return texts;
}

/// A note if the cloud is written as PLY, which cannot store its viewpoint. Empty if there is
/// nothing to note.
std::string about_viewpoint(const OutputPaths& files, const Cloud* cloud) {
  if (cloud == nullptr) return {};
  const auto& [x, y, z, qw, qx, qy, qz] = cloud->viewpoint;
  if (x == 0 && y == 0 && z == 0) return {};
  for (const std::string& path : {files.output, files.coloured})
    if (!path.empty() && cloud_format_of(path) == CloudFormat::ply)
      return fmt::format("{}: PLY does not hold the viewpoint; read it with --viewpoint {},{},{}",
                         printable(path), x, y, z);
  return {};
}

/// Keeps the view for the next frame, and warns if the camera has moved since the last frame.
void remember(const Segmentation& s, Remembered& remembered, std::vector<std::string>& warned) {
  if (!s.tree.plane) return;
  if (const auto motion = camera_motion(remembered.last, s.tree))
    warned.push_back(
        fmt::format("the camera moved: since the last frame the plane turned by {:.1f} degrees and "
                    "its distance changed by {:.1f} mm",
                    motion->turn, 1e3 * motion->shift));
  remembered.last.plane = s.tree.plane;
  remembered.last.viewpoint = s.tree.viewpoint;
}

Outcome outcome_of(const Arguments& arguments, app::Session& session, const OfStream* stream) {
  if (!stream) require_separate(arguments, session);
  Outputs outputs(arguments);
  Remembered* const remembered = stream ? stream->remembered : nullptr;
  Result result =
      result_of(arguments, remembered ? remembered->last.plane : std::nullopt, outputs, session);
  Segmentation& s = result.segmentation;
  std::vector<std::string> warned = notes_on(result, arguments);
  if (remembered) remember(s, *remembered, warned);
  std::string lost = about_viewpoint(arguments.files, result.cloud ? &*result.cloud : nullptr);
  if (!lost.empty()) warned.push_back(std::move(lost));
  for (const std::string& text : warned) session.note(text);
  explain_stages(s, arguments, session);

  // --explain is answered before any file is written, because the labels that it names may not
  // exist.
  std::optional<std::string> answer;
  if (const auto& labels = arguments.explain)
    answer = explanation(s, (*labels)[0], (*labels)[1]);
  else if (!stream && prints(arguments))
    answer = text_summary(s);
  RunInfo info{.program = app::program_and_version(std::string(kProgram.name)),
               .input = arguments.input.empty() ? arguments.image.depth : arguments.input,
               .read_seconds = result.read_seconds,
               .from_tree = !result.cloud,
               .sha256 = result.sha256,
               .warnings = std::move(warned)};
  if (remembered) {
    info.numbers = remembered->tracker.update(s.tree, s.cut);
    for (Segment& segment : s.cut.segments) {
      const Standing& standing = remembered->tracker.standings()[segment.label - 1];
      segment.role = standing.role;
      segment.on = standing.on;
    }
  }
  if (arguments.signatures) info.signatures = signatures_of(s, session);
  const app::BarHold results_are_written(session);
  outputs.write(result.cloud ? &*result.cloud : nullptr, s, info, session.context());
  if (answer) write_file("-", *answer);
  return {s.difference.empty() ? app::kOk : app::kDifference, one_line_summary(s),
          stream && stream->json ? json_summary(arguments, s, info) : ""};
}

}  // namespace

Outcome run_frame(const Arguments& arguments, app::Session& session, const OfStream* stream) {
  try {
    return outcome_of(arguments, session, stream);
  } catch (...) {
    const app::BarHold next_frame_is_not_there_yet(session);
    throw;
  }
}

int run(Arguments& arguments, app::Session& session) {
  for (const std::string& text : idle_options(arguments)) session.note(text);
  load_camera(arguments.image, session);
  if (arguments.is_stream()) return run_stream(arguments, session);
  const Outcome outcome = run_frame(arguments, session, nullptr);
  session.note(outcome.summary);
  return outcome.code;
}

}  // namespace ph::segment
