// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "common/arguments/cli_names.hpp"

namespace ph::app {

/// The situations that an option may meet: kinds of input, complexes, methods. Each has one bit;
/// each program names its own.
using Situations = std::uint32_t;

/// The situations in which an option has an effect. In any other situation the option is refused as
/// a misunderstanding: ignoring it would answer a question that nobody asked.
struct OptionScope {
  std::string_view option;     ///< "metric": a long name, without dashes
  Situations where;            ///< it has an effect in any of these
  std::string_view meant_for;  ///< the word for them: "points"
};

/// The options of a program that were given, in the order of --help.
std::vector<const OptionScope*> given_scopes(const CLI::App& app,
                                             std::span<const OptionScope> scopes);

/// @param here the actual situation, one bit. @param found the word for it.
/// @throws Error (usage): "--metric: makes sense for points only, found an image".
void require_in_scope(std::span<const OptionScope* const> given, Situations here,
                      std::string_view found);

}  // namespace ph::app
