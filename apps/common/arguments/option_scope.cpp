// SPDX-License-Identifier: MIT
#include "common/arguments/option_scope.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>

#include "ph/error.hpp"

namespace ph::app {

std::vector<const OptionScope*> given_scopes(const CLI::App& app,
                                             std::span<const OptionScope> scopes) {
  std::vector<const OptionScope*> given;
  for (const CLI::Option* option : app.get_options()) {
    const std::vector<std::string>& names = option->get_lnames();
    if (option->count() == 0 || names.empty()) continue;
    const auto scope = std::ranges::find(scopes, names.front(), &OptionScope::option);
    if (scope != scopes.end()) given.push_back(&*scope);
  }
  return given;
}

void require_in_scope(std::span<const OptionScope* const> given, Situations here,
                      std::string_view found) {
  for (const OptionScope* scope : given)
    if ((scope->where & here) == 0)
      throw Error(ErrorKind::usage, fmt::format("--{}: makes sense for {} only, found {}",
                                                scope->option, scope->meant_for, found));
}

}  // namespace ph::app
