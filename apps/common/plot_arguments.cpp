// SPDX-License-Identifier: MIT
#include "plot_arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "choices.hpp"
#include "ph/core/error.hpp"

namespace ph::app {
namespace {

bool ends_in(std::string_view path, std::string_view extension) {
  const auto equal = [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  };
  return path.size() >= extension.size() &&
         std::ranges::equal(path.substr(path.size() - extension.size()), extension, equal);
}

}  // namespace

bool Plot::is_png() const { return ends_in(path, ".png"); }

void require_known_format(const Plot& plot) {
  if (plot.is_png() && png_plot_support().empty())
    throw Error(ErrorKind::not_built_in,
                fmt::format("--plot {}: PNG plots are not built in; use .svg", plot.path));
  if (!plot.is_png() && !ends_in(plot.path, ".svg"))
    throw Error(
        ErrorKind::usage,
        fmt::format("--plot: found '{}', expected a name that ends in .svg or .png", plot.path));
}

std::vector<Plot> PlotArguments::together(std::string_view usual) const {
  if (kinds.size() > paths.size())
    throw Error(ErrorKind::usage, paths.empty() ? "--plot-kind needs --plot FILE"
                                                : "--plot-kind was given more often than --plot");
  std::vector<Plot> plots;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i].empty()) throw Error(ErrorKind::usage, "--plot: found '', expected a path");
    if (std::find(paths.begin(), paths.begin() + static_cast<std::ptrdiff_t>(i), paths[i]) !=
        paths.begin() + static_cast<std::ptrdiff_t>(i))
      throw Error(ErrorKind::usage,
                  fmt::format("--plot: found '{}' twice, expected a file for each", paths[i]));
    plots.push_back(
        {paths[i], kinds.empty() ? std::string(usual) : kinds[std::min(i, kinds.size() - 1)]});
  }
  return plots;
}

void add_plot_options(CLI::App& app, std::span<const std::string_view> kinds,
                      const std::string& description, const std::string& group, PlotArguments& to) {
  const auto add = [&](const std::string& name, const std::string& placeholder,
                       const std::string& what, auto take) {
    app.add_option_function<std::vector<std::string>>(name, take, what)
        ->type_name(placeholder)
        ->type_size(1)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->group(group);
  };
  add("--plot", "FILE.svg|.png", description,
      [&to](const std::vector<std::string>& paths) { to.paths = paths; });
  add("--plot-kind", fmt::format("{}", fmt::join(kinds, "|")),
      fmt::format("kind of each --plot in turn; the last one counts for the rest (default: {})",
                  kinds.front()),
      [&to, kinds](const std::vector<std::string>& words) {
        for (const std::string& word : words)
          to.kinds.emplace_back(kinds[choose("--plot-kind", word, kinds)]);
      });
}

}  // namespace ph::app
