// SPDX-License-Identifier: MIT
#include "apps/common/arguments/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "apps/common/values/choices.hpp"
#include "ph/error.hpp"

namespace ph::app {

void Options::topic(std::string_view name) { cli_.option_defaults()->group(std::string(name)); }

void Options::inputs(const std::string& name, const std::string& description,
                     std::vector<std::string>& to) {
  cli_.add_option(name, to, description)->type_name("");
}

CLI::Option* Options::limit(CLI::Option* option, const Scope& scope) {
  if (scope.where != Scope().where) scopes_.emplace(option, scope);
  return option;
}

CLI::Option* Options::value(const OptionName& name, const std::string& placeholder,
                            const std::string& description,
                            const std::function<void(const std::string& value)>& take) {
  CLI::Option* option = cli_.add_option_function<std::string>(name.names, take, description);
  return limit(option->type_name(placeholder)->type_size(1), name.scope);
}

CLI::Option* Options::repeated(
    const OptionName& name, const std::string& placeholder, const std::string& description,
    const std::function<void(const std::vector<std::string>& values)>& take) {
  // mutant: plot-arguments
  CLI::Option* option =
      cli_.add_option_function<std::vector<std::string>>(name.names, take, description)
          ->type_name(placeholder)
          ->type_size(1)
          ->expected(1)
          ->allow_extra_args(false)  // the next argument may be an input
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return limit(option, name.scope);
}

CLI::Option* Options::path(const OptionName& name, const std::string& placeholder,
                           const std::string& description, std::string& path) {
  return value(
      name, placeholder, description, [&path, names = name.names](const std::string& text) {
        if (text.empty())
          throw Error(ErrorKind::usage, fmt::format("{}: found '', expected a path", names));
        path = text;
      });
}

CLI::Option* Options::flag(const OptionName& name, const std::string& description, bool& is_given) {
  return limit(cli_.add_flag(name.names, is_given, description), name.scope);
}
CLI::Option* Options::flag(const OptionName& name, const std::string& description,
                           const std::function<void()>& take) {
  return limit(cli_.add_flag_callback(name.names, take, description), name.scope);
}

CLI::Option* Options::choice(const OptionName& name, const std::vector<std::string_view>& choices,
                             const std::string& description,
                             const std::function<void(std::size_t)>& take) {
  return value(
      name, fmt::format("{}", fmt::join(choices, "|")), description,
      [=, names = name.names](const std::string& word) { take(choose(names, word, choices)); });
}

void Options::hide_outside(Situations situations) {
  for (CLI::Option* option : cli_.get_options())
    if (const auto found = scopes_.find(option);
        found != scopes_.end() && (found->second.where & situations) == 0)
      option->group("");
}

std::vector<GivenOption> Options::given() const {
  std::vector<GivenOption> given;
  for (const CLI::Option* option : cli_.get_options())
    if (const auto found = scopes_.find(option); found != scopes_.end() && option->count() > 0)
      given.push_back({option->get_lnames().front(), found->second});
  return given;
}

}  // namespace ph::app
