// SPDX-License-Identifier: MIT
#include "run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "arguments.hpp"
#include "exit_code.hpp"
#include "outputs.hpp"
#include "ph/core/error.hpp"
#include "ph/io/output_file.hpp"
#include "session.hpp"
#include "summary.hpp"

namespace ph::segment {
namespace {

constexpr std::string_view kProgram = "ph-segment";

Cloud read_depth(const DepthInput& image, const RunContext& context) {
  const Raster depth = read_png(image.depth, &context);
  std::optional<Raster> colour;
  if (!image.colour.empty()) colour = read_png(image.colour, &context);
  return cloud_from_depth(depth, colour, *image.intrinsics, image.scale);
}

Cloud read_input(const Arguments& arguments, app::Session& session) {
  if (arguments.input.empty()) return read_depth(arguments.image, session.context());
  ReadOptions options;
  options.context = &session.context();
  options.allow_empty = arguments.allow_empty;
  options.note = [&session](const std::string& text) { session.note(text); };
  return ph::read_cloud(arguments.input, options);
}

/// What a user should know before trusting the result.
void warn(const Segmentation& s, const SegmentOptions& options, app::Session& session) {
  if (!s.difference.empty()) session.note("check: " + s.difference);
  if (!s.stages.empty() && s.stages.front().points == 0) {
    session.note(fmt::format("no point within {} m of the viewpoint{}; see --max-range",
                             options.max_range, options.crop ? " and inside the crop box" : ""));
  } else if (options.plane && !s.plane) {
    session.note(s.plane_note + "; nothing removed");
  }
}

/// The library knows what is missing, the program which of its options help.
Segmentation segment_within_limits(const Cloud& cloud, const SegmentOptions& options,
                                   const RunContext& context) {
  try {
    return segment(cloud, options, context);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::resource) throw;
    throw Error(ErrorKind::resource,
                fmt::format("{}; lower --distance or --max-range, enlarge --voxel, or raise "
                            "--memory-limit",
                            error.what()));
  }
}

}  // namespace

int run(int argc, const char* const* argv, std::stop_token stop) {
  Arguments arguments;
  if (const auto answer = parse_arguments(argc, argv, arguments))
    return app::answer_command_line(*answer);
  app::Session session(kProgram, arguments.common, std::move(stop));
  Outputs outputs(arguments);

  const auto start = std::chrono::steady_clock::now();
  const Cloud cloud = read_input(arguments, session);
  const std::chrono::duration<double> reading = std::chrono::steady_clock::now() - start;
  outputs.require_suitable(cloud);

  const Segmentation result = segment_within_limits(cloud, arguments.options, session.context());
  warn(result, arguments.options, session);
  session.note(one_line_summary(cloud, result));
  for (const Stage& stage : result.stages) {
    session.explain(
        fmt::format("{:12} {:8} points {:9.3f} ms", stage.name, stage.points, 1e3 * stage.seconds));
  }
  if (result.plane) {
    session.explain(
        fmt::format("plane {:.4f} x + {:.4f} y + {:.4f} z + {:.4f} = 0, {:.1f} % of "
                    "the points in range",
                    result.plane->normal[0], result.plane->normal[1], result.plane->normal[2],
                    result.plane->offset, 100 * result.plane->share));
  }
  // Before anything is written: the labels may not be there.
  std::optional<std::string> answer;
  if (const auto& labels = arguments.explain)
    answer = explanation(result, (*labels)[0], (*labels)[1]);
  else if (!arguments.writes_files())
    answer = text_summary(result);
  const std::string& path = arguments.input.empty() ? arguments.image.depth : arguments.input;
  outputs.write(cloud, result,
                {app::program_and_version(std::string(kProgram)), path, reading.count()});
  if (answer) write_file("-", *answer);
  return result.difference.empty() ? app::kOk : app::kDifference;
}

}  // namespace ph::segment
