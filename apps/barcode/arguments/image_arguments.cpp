// SPDX-License-Identifier: MIT
#include "apps/barcode/arguments/argument_groups.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/common/inputs/set_options.hpp"
#include "apps/common/values/numbers.hpp"

namespace ph::barcode {

using app::parse_integer;
using app::parse_integers;
using app::parse_number;

namespace {

void take_periodic(Job& job, const std::string& text) {
  if (text == "all") {
    job.question.cubical.periodic.assign(Cubical::kMaxDim, true);
    return;
  }
  for (const std::int64_t number : parse_integers("--periodic", text, 0, Cubical::kMaxDim - 1)) {
    const auto axis = static_cast<std::size_t>(number);
    if (job.question.cubical.periodic.size() <= axis)
      job.question.cubical.periodic.resize(axis + 1, false);
    job.question.cubical.periodic[axis] = true;
  }
}

}  // namespace

void add_cubical_options(app::Options& options, Job& job) {
  options.topic("cubical");
  options.choice({"--construction", kOfCubical}, "voxels are vertices (default) or top cells",
                 job.question.cubical.construction);
  options.flag({"--superlevel", kOfCubical},
               "superlevel sets, the largest values first; values are those of the negated image",
               [&job] { job.question.cubical.superlevel = true; });
  options.value({"--periodic", kOfCubical}, "AXES",
                "axes that close up on themselves, such as 0,2, or all (default: none)",
                [&job](const std::string& text) { take_periodic(job, text); });
  options.value({"--slab-layers", kOfCubical}, "N",
                "layers along the first axis that are looked at together; the bars are the same "
                "(default: all if the memory limit allows it, else as many as it does)",
                [&job](const std::string& text) {
                  constexpr Index most = Index{1} << 30;
                  job.common.slab_layers =
                      static_cast<int>(parse_integer("--slab-layers", text, 1, most));
                });
  options.value(
      {"--voxel", kOfVoxels}, "X",
      "of points with --complex cubical: edge of the voxels that they lie in, in their unit",
      [&job](const std::string& text) {
        job.question.voxel = parse_number("--voxel", text);
        if (!(*job.question.voxel > 0) || !std::isfinite(*job.question.voxel))
          throw Error(ErrorKind::usage,
                      fmt::format("--voxel: found '{}', expected a finite number above 0", text));
      });
  options.choice(
      {"--voxel-value", kOfVoxels},
      "what such a voxel is worth: the distance to the nearest voxel with a point (default); "
      "0 with a point, else it is not there; minus the number of its points",
      job.question.voxel_value);
}

void add_raw_options(app::Options& options, Job& job) {
  options.topic("raw");
  options.value(
      {"--raw-shape", kOfRaw}, "N,M,…",
      "sizes of the axes, the last one fastest, of an image without a header (--format raw)",
      [&job](const std::string& text) {
        constexpr Index most = Index{1} << 32;
        const auto extents = parse_integers("--raw-shape", text, 0, most);
        app::raw_layout(job.reading.options).extents.assign(extents.begin(), extents.end());
      });
  app::add_raw_options(options, kOfRawPoints, kOfRawNumbers,
                       "uint8 for an image, float32 for points", job.reading.options);
}

void check_image_arguments(Job& job) {
  std::optional<RawLayout>& layout = job.reading.options.raw;
  if (!layout) {
    if (job.reading.format == Format::raw)
      throw Error(ErrorKind::usage, "--format: found raw, which needs --raw-shape or --raw-points");
    return;
  }
  const bool is_cloud = layout->coordinates != 0;
  if (layout->extents.empty() && !is_cloud)
    throw Error(ErrorKind::usage,
                "--raw-type, --raw-big-endian and --raw-skip need --raw-shape or --raw-points");
  if (!layout->extents.empty() && is_cloud)
    throw Error(ErrorKind::usage,
                "--raw-points: cannot be combined with --raw-shape, which reads an image");
  if (job.reading.format == Format::automatic) job.reading.format = Format::raw;
  if (job.reading.format != Format::raw)
    throw Error(ErrorKind::usage, fmt::format("{}: makes sense for --format raw only",
                                              is_cloud ? "--raw-points" : "--raw-shape"));
  app::settle_raw(*layout);
}

}  // namespace ph::barcode
