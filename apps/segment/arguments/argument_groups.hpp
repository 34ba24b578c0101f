// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/arguments/cli_names.hpp"
#include "common/arguments/command_line.hpp"
#include "common/arguments/plot_arguments.hpp"
#include "segment/arguments/arguments.hpp"

// The options of ph-segment by topic. What they are put into must outlive `app`.
namespace ph::segment {

/// A number that must be above zero (or, with `zero`, at least zero) and finite.
double length(std::string_view option, const std::string& text, bool zero = false);

/// Options that others contradict. Not asked for by name: that ends the program if there is no
/// memory for a copy of the name.
struct Known {
  CLI::Option *method = nullptr, *supervoxels = nullptr, *min_persistence = nullptr,
              *plot_view = nullptr;
};

/// What comes before the plane is gone.
void add_scene_options(CLI::App& app, SegmentOptions& options);
Known add_method_options(CLI::App& app, SegmentOptions& options);
/// What a stored tree follows, too. Contradictions are refused.
void add_cut_options(CLI::App& app, CutArguments& cut, const Known& known);
void add_output_options(CLI::App& app, Arguments& arguments, app::PlotArguments& plots,
                        Known& known);

/// Puts what was said of plots into the arguments. @throws Error (usage).
void take_plots(Arguments& arguments, const app::PlotArguments& plots, const Known& known);
/// Those of the options that were given which make the scene, for a command that cuts it elsewhere.
std::vector<std::string> scene_options(const CLI::App& app);

}  // namespace ph::segment
