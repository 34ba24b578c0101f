// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/arguments/options.hpp"
#include "common/arguments/plot_arguments.hpp"
#include "segment/arguments/arguments.hpp"
#include "segment/arguments/scopes.hpp"

// The options of ph-segment by topic. What they are put into must outlive `options`.
namespace ph::segment {

/// A number that must be above zero (or, with `zero`, at least zero) and finite.
double length(std::string_view option, const std::string& text, bool zero = false);

/// Options that other options may contradict. They are not looked up by name, because a lookup ends
/// the program if there is no memory for a copy of the name.
struct Known {
  CLI::Option *method = nullptr, *supervoxels = nullptr, *min_persistence = nullptr,
              *plot_view = nullptr;
};

/// What comes before the plane is gone.
void add_scene_options(app::Options& options, SegmentOptions& to);
Known add_method_options(app::Options& options, SegmentOptions& to);
/// What a stored tree follows, too. Contradictions are refused.
void add_cut_options(app::Options& options, CutArguments& cut, const Known& known);
void add_output_options(app::Options& options, Arguments& arguments, app::PlotArguments& plots,
                        Known& known);

/// Stores the options for plots in the arguments. @throws Error (usage).
void take_plots(Arguments& arguments, const app::PlotArguments& plots, const Known& known);
/// Those of the options that were given which make the scene, for a command that cuts it elsewhere.
std::vector<std::string> scene_options(const app::Options& options);

}  // namespace ph::segment
