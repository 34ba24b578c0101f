// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/arguments/cli_names.hpp"
#include "common/manual/manual.hpp"
#include "ph/detail/core/names.hpp"

namespace ph::app {

enum class ProgressMode { automatic, bar, json, none };

/// The options that all programs share.
struct CommonOptions {
  int threads = 0;                            ///< 0: one per core
  std::optional<std::uint64_t> memory_limit;  ///< bytes; default: the memory of the machine
  int slab_layers = 0;                        ///< layers of images, as in RunContext
  ProgressMode progress = ProgressMode::automatic;
  std::optional<int> rank;  ///< stated in lines of progress
  bool quiet = false;
  bool verbose = false;
  bool force = false;               ///< outputs may replace inputs
  std::optional<std::string> help;  ///< the topic of --help
  bool version = false;
};

/// Registers the common options. `options` must outlive `app`.
void add_common_options(CLI::App& app, CommonOptions& options);

/// Adds an option whose value is read by a given function: strict, and its errors pass unchanged.
/// An option that is given twice is an error. @param names "--max-dim" or "-o,--output". @param
/// placeholder "D".
CLI::Option* add_value(CLI::App& app, const std::string& names, const std::string& placeholder,
                       const std::string& description,
                       const std::function<void(const std::string& value)>& take);

/// The same for a value from a list of names: `take` receives the position of the given one.
CLI::Option* add_choice(CLI::App& app, const std::string& names,
                        const std::vector<std::string_view>& choices,
                        const std::string& description,
                        const std::function<void(std::size_t)>& take);
/// The same for the values of an enum: `take` gets the one of the name that was given.
template <class Enum>
CLI::Option* add_choice(CLI::App& app, const std::string& names, const std::string& description,
                        const std::function<void(Enum)>& take,
                        std::span<const Named<Enum>> choices = names_of<Enum>) {
  std::vector<std::string_view> words;
  for (const Named<Enum>& choice : choices) words.push_back(choice.name);
  return add_choice(app, names, words, description, [=](std::size_t i) { take(choices[i].value); });
}
/// The same for all values of an enum. The one that was given is put into `to`, an Enum or an
/// optional one, which outlives `app`.
template <class Enum>
requires std::is_enum_v<Enum> CLI::Option* add_choice(CLI::App& app, const std::string& names,
                                                      const std::string& description, Enum& to) {
  return add_choice<Enum>(app, names, description, [&to](Enum value) { to = value; });
}
template <class Enum>
CLI::Option* add_choice(CLI::App& app, const std::string& names, const std::string& description,
                        std::optional<Enum>& to) {
  return add_choice<Enum>(app, names, description, [&to](Enum value) { to = value; });
}
/// The same for a path, which is not empty; it is put into `path`, which outlives `app`.
CLI::Option* add_path(CLI::App& app, const std::string& names, const std::string& placeholder,
                      const std::string& description, std::string& path);

/// The command line as it was typed, under the program's own name.
std::vector<std::string> typed_command(std::string_view program, int argc, const char* const* argv);
/// The given options, each as a long name and its values, in the order of --help. A command line
/// with them does the same again. Common options and INPUT are left out.
/// @param without long names to leave out, without dashes.
std::vector<std::string> given_options(const CLI::App& app,
                                       std::span<const std::string_view> without);

/// Parses the command line; prints nothing.
/// @return the answer to --help or --version, if one was asked for.
/// @throws Error (usage) that names the option and the nearest known one.
std::optional<std::string> parse_command_line(CLI::App& app, const CommonOptions& options, int argc,
                                              const char* const* argv, const Manual& manual);

/// Prints the answer to --help and similar options. @return the exit code.
int answer_command_line(const std::string& answer);

/// "ph-barcode 0.1.0"
std::string program_and_version(const std::string& program);

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
