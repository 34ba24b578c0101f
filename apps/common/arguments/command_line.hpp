// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/common/manual/manual.hpp"
#include "ph/detail/core/names.hpp"

namespace ph::app {

class Options;

enum class ProgressMode { automatic, bar, json, none };

/// The options that all programs share.
struct CommonOptions {
  int threads = 0;  ///< 0 means one per core
  /// The limit in bytes. The default is machine_memory().
  std::optional<std::uint64_t> memory_limit;
  int slab_layers = 0;  ///< layers of images, as in RunContext
  ProgressMode progress = ProgressMode::automatic;
  std::optional<int> rank;  ///< the rank that lines of progress state
  bool quiet = false;
  bool verbose = false;
  bool force = false;               ///< true if outputs may replace inputs
  std::optional<std::string> help;  ///< the topic of --help
  bool version = false;
};

/// Registers the common options.
void add_common_options(Options& options, CommonOptions& common);

/// The command line as it was typed, under the program's own name.
std::vector<std::string> typed_command(std::string_view program, int argc, const char* const* argv);
/// The given options, each as a long name and its values, in the order of --help. A command line
/// with these options repeats the run. Common options and INPUT are left out.
/// @param without long names to leave out, without dashes.
std::vector<std::string> given_options(const Options& options,
                                       std::span<const std::string_view> without);

/// Parses the command line, and prints nothing.
/// @return the answer to --help or --version, if one of these options was given.
/// @throws Error (usage), which names the option and the nearest known option.
std::optional<std::string> parse_command_line(Options& options, const CommonOptions& common,
                                              int argc, const char* const* argv,
                                              const Manual& manual);

/// Prints the answer to --help and similar options. @return the exit code.
int answer_command_line(const std::string& answer);

}  // namespace ph::app

namespace ph {

template <>
inline constexpr std::array names_of<app::ProgressMode>{
    Named{app::ProgressMode::automatic, "auto"},
    Named{app::ProgressMode::bar, "bar"},
    Named{app::ProgressMode::json, "json"},
    Named{app::ProgressMode::none, "none"},
};

}  // namespace ph
