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

// The options of ph-segment by topic. The objects that receive them must outlive `app`.
namespace ph::segment {

/// A number that must be above zero (or, with `zero`, at least zero) and finite.
double length(std::string_view option, const std::string& text, bool zero = false);

/// Options that other options may contradict. They are not looked up by name, because a lookup ends
/// the program if there is no memory for a copy of the name.
struct Known {
  CLI::Option *method = nullptr, *supervoxels = nullptr, *min_persistence = nullptr,
              *plot_view = nullptr;
};

/// The options for the stages before the plane is removed.
void add_scene_options(CLI::App& app, SegmentOptions& options);
Known add_method_options(CLI::App& app, SegmentOptions& options);
/// The options that also apply to a stored tree. Contradictions are refused.
void add_cut_options(CLI::App& app, CutArguments& cut, const Known& known);
void add_output_options(CLI::App& app, Arguments& arguments, app::PlotArguments& plots,
                        Known& known);

/// Stores the options for plots in the arguments. @throws Error (usage).
void take_plots(Arguments& arguments, const app::PlotArguments& plots, const Known& known);
/// The given options that affect the scene, for a command that makes another cut.
std::vector<std::string> scene_options(const CLI::App& app);

}  // namespace ph::segment
