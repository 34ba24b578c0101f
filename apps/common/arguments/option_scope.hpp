// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "common/arguments/cli_names.hpp"

namespace ph::app {

/// What an option may meet: kinds of input, complexes, methods. A bit each; a program names them.
using Situations = std::uint32_t;

/// Where an option does something. Given anywhere else it is a misunderstanding, and refused: an
/// option that is ignored gives an answer to a question that nobody asked.
struct OptionScope {
  std::string_view option;     ///< "metric": a long name, without dashes
  Situations where;            ///< it does something in any of them
  std::string_view meant_for;  ///< what they are: "points"
};

/// Those of a program's options that were given, in the order of --help.
std::vector<const OptionScope*> given_scopes(const CLI::App& app,
                                             std::span<const OptionScope> scopes);

/// @param here where the program finds itself: one situation. @param found what that is.
/// @throws Error (usage): "--metric: makes sense for points only, found an image".
void require_in_scope(std::span<const OptionScope* const> given, Situations here,
                      std::string_view found);

}  // namespace ph::app
