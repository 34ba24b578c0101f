// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/common/arguments/options.hpp"
#include "apps/common/arguments/plot_arguments.hpp"
#include "apps/segment/arguments/arguments.hpp"
#include "apps/segment/arguments/scopes.hpp"

// The options of ph-segment, sorted by topic. The objects that receive their values must outlive
// `options`.
namespace ph::segment {

/// A number that must be finite and above zero. With `zero`, it may also be zero.
double length(std::string_view option, const std::string& text, bool zero = false);

/// Options that other options may contradict. They are not looked up by name, because a lookup ends
/// the program if there is no memory for a copy of the name.
struct Known {
  CLI::Option *method = nullptr, *supervoxels = nullptr, *min_persistence = nullptr,
              *plot_view = nullptr;
};

/// Registers the options for the stages up to the removal of the plane.
void add_scene_options(app::Options& options, SegmentOptions& to);
Known add_method_options(app::Options& options, SegmentOptions& to);
/// Registers the options that also apply to a stored tree, and refuses contradictions.
void add_cut_options(app::Options& options, CutArguments& cut, const Known& known);
void add_output_options(app::Options& options, Arguments& arguments, app::PlotArguments& plots,
                        Known& known);

/// Stores the options for plots in the arguments. @throws Error (usage).
void take_plots(Arguments& arguments, const app::PlotArguments& plots, const Known& known);
/// The given options that affect the scene, for a command that makes another cut.
std::vector<std::string> scene_options(const app::Options& options);

}  // namespace ph::segment
