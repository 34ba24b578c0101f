// SPDX-License-Identifier: MIT
#include "apps/barcode/arguments/argument_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/common/files/batch_names.hpp"
#include "apps/common/values/choices.hpp"
#include "apps/common/values/numbers.hpp"

namespace ph::barcode {
namespace {

/// Parses "R=FILE". R is the value at which the surface of the complex is taken, and FILE is the
/// file that receives its triangles.
Surface surface_of(const std::string& option, const std::string& text, bool is_wrap) {
  const auto fail = [&] {
    throw Error(ErrorKind::usage,
                fmt::format("{}: found '{}', expected R=FILE.ply or R=FILE.off", option, text));
  };
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals + 1 == text.size()) fail();
  Surface surface{app::parse_number(option, text.substr(0, equals)), text.substr(equals + 1),
                  is_wrap};
  const bool is_place = surface.path.ends_with('/') || app::is_folder(surface.path);
  if (!is_place && !surface_format_of_path(surface.path)) fail();
  return surface;
}

}  // namespace

void add_alpha_options(app::Options& options, Job& job) {
  options.topic("alpha");
  options.choice({"--alpha-values", kOfAlpha},
                 "what values are: the radius of the balls, or its square (default radius; with "
                 "--weights squared)",
                 job.question.alpha_unit);
  options.path({"--weights", kOfAlpha}, "FILE",
               "the square of each ball's first radius, one number per point (default: all 0); of "
               "complex alpha",
               job.question.weights);
  options.value({"--period", kOfAlpha}, "L|L,L,…",
                "points of a periodic space: the length after which each axis closes up, one for "
                "all or one an axis; 0: it does not",
                [&job](const std::string& text) {
                  job.question.period = app::parse_numbers("--period", text);
                  for (const double length : job.question.period)
                    if (!(length >= 0 && std::isfinite(length)))
                      throw Error(ErrorKind::usage,
                                  fmt::format("--period: found '{}', expected finite numbers of "
                                              "at least 0",
                                              text));
                });
  const auto add_surfaces = [&](const std::string& option, const std::string& what, bool is_wrap) {
    options.repeated({option, kOfAlpha}, "R=FILE.ply|.off", what,
                     [&job, option, is_wrap](const std::vector<std::string>& all) {
                       for (const std::string& text : all)
                         job.places.surfaces.push_back(surface_of(option, text, is_wrap));
                     });
  };
  add_surfaces("--alpha-shape",
               "the surface of the complex at value R, as triangles in a file (repeatable)", false);
  add_surfaces("--wrap",
               "the same of what is left after all collapses: the wrap complex at R (repeatable)",
               true);
}

void check_alpha_arguments(Job& job) {
  const bool is_weighted = !job.question.weights.empty();
  if (is_weighted && job.question.alpha_unit == AlphaOptions::Unit::radius)
    throw Error(ErrorKind::usage,
                "--alpha-values: found radius with --weights, expected squared, because squared "
                "radii may be negative");
  const std::string_view name = complex_names()[static_cast<std::size_t>(job.question.complex)];
  const bool is_alpha = job.question.complex != ComplexKind::delaunay_cech &&
                        job.question.complex != ComplexKind::delaunay_rips;
  if (is_weighted && !is_alpha)
    throw Error(ErrorKind::usage,
                fmt::format("--weights: found --complex {}, expected --complex alpha", name));
  if (!job.places.surfaces.empty() && !is_alpha)
    throw Error(ErrorKind::usage, fmt::format("{}: found --complex {}, expected --complex alpha",
                                              job.places.surfaces[0].option(), name));
  const bool is_periodic =
      std::ranges::any_of(job.question.period, [](double length) { return length > 0; });
  if (is_periodic && !is_alpha)
    throw Error(ErrorKind::usage,
                fmt::format("--period: found --complex {}, expected --complex alpha", name));
  if (is_periodic && !job.places.surfaces.empty())
    throw Error(ErrorKind::usage,
                fmt::format("{}: cannot be combined with --period; leave out one of them",
                            job.places.surfaces[0].option()));
  for (const Surface& surface : job.places.surfaces)
    if (job.question.threshold && surface.value > *job.question.threshold)
      throw Error(ErrorKind::usage,
                  fmt::format("{}: found {}, expected at most --threshold ({})", surface.option(),
                              surface.value, *job.question.threshold));
  if (!job.question.alpha_unit)
    job.question.alpha_unit =
        is_weighted ? AlphaOptions::Unit::squared : AlphaOptions::Unit::radius;
  if (is_weighted && job.question.weights == "-" && std::ranges::count(job.inputs, "-") > 0)
    throw Error(ErrorKind::usage, "--weights: standard input can be read once only");
}

}  // namespace ph::barcode
