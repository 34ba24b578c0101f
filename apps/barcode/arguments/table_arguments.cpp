// SPDX-License-Identifier: MIT
#include "apps/barcode/arguments/argument_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "apps/common/inputs/set_options.hpp"
#include "apps/common/values/numbers.hpp"

namespace ph::barcode {

namespace {

void take_delay(Job& job, const std::string& text) {
  const std::vector<std::int64_t> numbers = app::parse_integers("--delay", text, 1);
  if (numbers.size() > 2)
    throw Error(ErrorKind::usage,
                fmt::format("--delay: found '{}', expected D or D,TAU", printable(text, 80)));
  job.reading.delay = {numbers[0], numbers.size() == 2 ? numbers[1] : 1};
}

}  // namespace

void add_table_options(app::Options& options, Job& job) {
  options.topic("input");
  app::add_columns_option(options, kOfInputs.with(kSomeBlocks), job.reading.options);
  options.value(
      {"--delay", {kPoints | kAlpha | kOwn, "Rips and alpha complexes of time series"}}, "D,TAU",
      "the input is a time series, a row for each time: points are its values at D times, "
      "TAU rows apart (default TAU 1)",
      [&job](const std::string& text) { take_delay(job, text); });
  options.choice<Channel>(
      {"--channel", kOfInputs.with(kSomeLayers)},
      "what of a colour picture is read (default: its grey, if it has no colours); grey of "
      "colours is their luma, 0.299 R + 0.587 G + 0.114 B",
      [&job](Channel channel) { job.reading.options.channel = channel; },
      std::span(names_of<Channel>).subspan(1));
  options.flag({"--stack", kOfInputs.with(kSomeLayers)},
               "the input is a folder of PNG, PGM or TIFF pictures: they are the slices of one "
               "volume, in the order of the numbers in their names",
               [&job] { job.reading.options.stack = true; });
  options.flag({"--weld", kOfMeshes},
               "vertices of the mesh at the same position become one vertex, as along the seams of "
               "a texture",
               [&job] { job.reading.options.weld = true; });
}

void check_table_arguments(Job& job) {
  ArrayMeaning& meaning = job.reading.options.array;
  if (job.reading.delay) {
    if (job.reading.options.nan == NanPolicy::drop)
      throw Error(ErrorKind::usage,
                  "--delay: cannot be combined with --nan drop, because no time may be missing in "
                  "a time series");
    // An array that is read as an image may have one axis or two axes.
    if (job.reading.format == Format::automatic) meaning = ArrayMeaning::image;
  }
  if (job.reading.format == Format::distance) meaning = ArrayMeaning::distances;
  if (meaning != ArrayMeaning::automatic) return;
  // An option that has an effect for only one kind of input determines the kind of the input.
  const auto is_only_for = [&](app::Situations kinds) {
    return std::ranges::any_of(job.given, [&](const app::GivenOption& option) {
      return (option.scope.where & ~kinds) == 0;
    });
  };
  const bool is_cubical = job.question.complex == ComplexKind::cubical;
  if (job.reading.format == Format::points || job.question.complex == ComplexKind::own ||
      is_triangulated(job.question.complex) || is_only_for(kPoints | kSomeBlocks) ||
      is_only_for(kVoxels))
    meaning = ArrayMeaning::points;
  else if (job.question.complex == ComplexKind::rips ||
           (!is_cubical && is_only_for(kPoints | kMatrix | kTriangle | kSomePairs | kSomeBlocks)))
    meaning = ArrayMeaning::rips;
  else if (is_cubical || is_only_for(kImage | kVoxels | kImagePart | kRanks) ||
           job.wants_image_part())
    meaning = ArrayMeaning::image;
}

}  // namespace ph::barcode
