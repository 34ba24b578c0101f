// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdint>

#include "apps/common/values/numbers.hpp"
#include "apps/segment/arguments/argument_groups.hpp"
#include "ph/error.hpp"

namespace ph::segment {
namespace {

constexpr std::array<std::string_view, 5> kPlotKinds = {"barcode", "diagram", "betti", "tree",
                                                        "cloud"};

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

ViewTurn parse_turn(std::string_view option, const std::string& text) {
  const std::vector<double> v = app::parse_numbers(option, text, 2);
  if (!(v[0] >= -360 && v[0] <= 360 && v[1] >= -90 && v[1] <= 90))
    throw Error(ErrorKind::usage,
                fmt::format("{}: found {}, expected degrees to the right from -360 to 360 and up "
                            "from -90 to 90",
                            option, text));
  return {v[0], v[1]};
}

}  // namespace

void add_output_options(app::Options& options, Arguments& a, app::PlotArguments& plots,
                        Known& known) {
  for (const OutputOption& of : output_options()) {
    const bool is_picture = of.kind == OutputKind::picture || of.kind == OutputKind::plot;
    options.topic(is_picture ? "pictures" : "output");
    const std::string help(of.help);
    if (of.path)
      options.path({std::string(of.names), of.scope},
                   fmt::format("FILE{}", fmt::join(of.extensions, "|")), help, a.files.*of.path);
    else
      app::add_plot_options(options, kPlotKinds, help, plots);
  }
  options.topic("output");
  options.flag("--signatures",
               "JSON: H0, H1 and H2 of the shape of each segment (a handle is a loop, a hollow a "
               "bar in dimension 2), in metres",
               a.signatures);
  options.topic("pictures");
  known.plot_view = options.value(
      "--plot-view", "RIGHT,UP",
      "where a plot of the cloud is seen from: by how much the eye goes around the segments "
      "from the viewpoint, degrees (default: 0,0)",
      [&a](const std::string& v) { a.plot_view = parse_turn("--plot-view", v); });
  options.topic("cuts");
  options.value("--explain", "A,B",
                "print where, and at which value of the filtration, the segments A and B join, in "
                "place of the table",
                [&a](const std::string& v) { a.explain = parse_labels("--explain", v); });
}

void take_plots(Arguments& a, const app::PlotArguments& plots, const Known& known) {
  a.files.plots = plots.together(kPlotKinds.front());
  a.files.look = plots.look;
  const bool shows_cloud = std::ranges::count(a.files.plots, "cloud", &app::Plot::kind) > 0;
  if (known.plot_view->count() > 0 && !shows_cloud)
    throw Error(ErrorKind::usage, "--plot-view needs --plot FILE --plot-kind cloud");
}

std::vector<std::string> scene_options(const app::Options& options) {
  std::vector<std::string_view> other{
      "signatures",   "explain", "plot-kind", "plot-view", "title",           "size",
      "axis",         "cut",     "objects",   "parts",     "min-persistence", "frames-from",
      "stable-labels"};
  for (const OutputOption& of : output_options()) other.push_back(of.option.substr(2));
  return app::given_options(options, other);
}

}  // namespace ph::segment
