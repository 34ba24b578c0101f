// SPDX-License-Identifier: MIT
#include "apps/common/arguments/plot_arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "apps/common/arguments/options.hpp"
#include "apps/common/files/batch_names.hpp"
#include "apps/common/values/choices.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/error.hpp"

namespace ph::app {
bool Plot::is_png() const { return ends_in(path, ".png"); }
bool Plot::is_svg() const { return ends_in(path, ".svg"); }

void require_known_format(const Plot& plot) {
  if (plot.is_png() && png_plot_support().empty())
    throw Error(ErrorKind::not_built_in,
                fmt::format("{} {}: PNG plots are not built in; use .svg", plot.option, plot.path));
  const bool is_place = plot.path.ends_with('/') || is_folder(plot.path);
  if (!plot.is_png() && !plot.is_svg() && !is_place)
    throw Error(ErrorKind::usage,
                fmt::format("{}: found '{}', expected a name that ends in .svg or .png",
                            plot.option, plot.path));
}

namespace {

/// Parses "LO,HI", "log" or both.
PlotAxis parse_axis(const std::string& text) {
  PlotAxis axis;
  std::string limits = text;
  if (limits == "log") {
    axis.logarithmic = true;
    return axis;
  }
  constexpr std::string_view kLog = ",log";
  if (limits.ends_with(kLog)) {
    axis.logarithmic = true;
    limits.resize(limits.size() - kLog.size());
  }
  const std::vector<double> ends = parse_numbers("--axis", limits, 2);
  if (!(ends[0] < ends[1]) || !std::isfinite(ends[0]) || !std::isfinite(ends[1]))
    throw Error(ErrorKind::usage, fmt::format("--axis: found '{}', expected LO,HI, a lower and a "
                                              "higher finite number",
                                              text));
  if (axis.logarithmic && ends[0] <= 0)
    throw Error(ErrorKind::usage,
                fmt::format("--axis: found '{}', expected numbers above 0 with log", text));
  axis.low = ends[0];
  axis.high = ends[1];
  return axis;
}

PlotSize parse_size(const std::string& text) {
  const std::size_t times = text.find('x');
  if (times == text.npos)
    throw Error(ErrorKind::usage,
                fmt::format("--size: found '{}', expected WIDTHxHEIGHT in pixels", text));
  const auto pixels = [](const std::string& number) {
    return static_cast<int>(parse_integer("--size", number, 1, kMostPlotPixels));
  };
  return {pixels(text.substr(0, times)), pixels(text.substr(times + 1))};
}

}  // namespace

std::vector<Plot> PlotArguments::together(std::string_view usual) const {
  if (kinds.size() > paths.size())
    throw Error(ErrorKind::usage, paths.empty() ? "--plot-kind needs --plot FILE"
                                                : "--plot-kind was given more often than --plot");
  if (paths.empty() && !looks.empty())
    throw Error(ErrorKind::usage, looks.front().option + " needs --plot FILE");
  std::vector<Plot> plots;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i].empty()) throw Error(ErrorKind::usage, "--plot: found '', expected a path");
    if (std::find(paths.begin(), paths.begin() + static_cast<std::ptrdiff_t>(i), paths[i]) !=
        paths.begin() + static_cast<std::ptrdiff_t>(i))
      throw Error(ErrorKind::usage,
                  fmt::format("--plot: found '{}' twice, expected a file for each", paths[i]));
    plots.push_back(
        {.path = paths[i],
         .kind = kinds.empty() ? std::string(usual) : kinds[std::min(i, kinds.size() - 1)]});
  }
  for (const PlotLook& wanted : looks)
    if (std::ranges::none_of(plots, wanted.fits))
      throw Error(ErrorKind::usage,
                  fmt::format("{}: makes sense for plots of {} only, found --plot-kind {}",
                              wanted.option, wanted.meant_for, plots.front().kind));
  return plots;
}

void add_plot_options(Options& options, std::span<const std::string_view> kinds,
                      const std::string& description, PlotArguments& to) {
  options.topic("pictures");
  options.repeated({"--plot", to.scope}, "FILE.svg|.png", description,
                   [&to](const std::vector<std::string>& paths) { to.paths = paths; });
  options.repeated(
      {"--plot-kind", to.scope}, fmt::format("{}", fmt::join(kinds, "|")),
      fmt::format("kind of each --plot in turn; the last one counts for the rest (default: {})",
                  kinds.front()),
      [&to, kinds](const std::vector<std::string>& words) {
        for (const std::string& word : words)
          to.kinds.emplace_back(kinds[choose("--plot-kind", word, kinds)]);
      });
  const auto is_any = [](const Plot&) { return true; };
  add_plot_look(options, {"--title", is_any, {}}, "TEXT", "title above each plot (default: none)",
                to, [&to](const std::string& text) { to.look.title = text; });
  add_plot_look(
      options, {"--size", is_any, {}}, "WxH",
      "size of each plot in pixels; the picture fits into it (default: 1040 across, in SVG 88 mm)",
      to, [&to](const std::string& text) { to.look.size = parse_size(text); });
  const auto has_axis = [](const Plot& plot) { return plot.shows_bars() || plot.kind == "tree"; };
  add_plot_look(
      options, {"--axis", has_axis, "bars and merge trees"}, "LO,HI|log|LO,HI,log",
      "filtration values on the axis of plots; log: logarithmic (default: all that there are)", to,
      [&to](const std::string& text) { to.look.axis = parse_axis(text); });
}

void add_plot_look(Options& options, const PlotLook& look, const std::string& placeholder,
                   const std::string& what, PlotArguments& to,
                   std::function<void(const std::string&)> take) {
  options.value({look.option, to.scope}, placeholder, what,
                [&to, look, take = std::move(take)](const std::string& text) {
                  to.looks.push_back(look);
                  take(text);
                });
}

}  // namespace ph::app
