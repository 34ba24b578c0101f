// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "apps/common/arguments/option_scope.hpp"
#include "apps/common/values/cli_names.hpp"
#include "ph/detail/core/names.hpp"

namespace ph::app {

/// What an option is called, and where it does something: {"-o,--output", {kPoints, "points"}}.
struct OptionName {
  OptionName(const char* all) : names(all) {}  // NOLINT(google-explicit-constructor)
  OptionName(std::string all, Scope where = {}) : names(std::move(all)), scope(where) {}

  std::string names;  ///< "-o,--output"
  Scope scope;
};

/// The options of a program, a row each: names, where it does something, a placeholder of its
/// value, a sentence, and where the value goes, which outlives `cli`. Errors of the functions that
/// read values pass unchanged. An option that is given twice is an error.
class Options {
 public:
  explicit Options(CLI::App& cli) : cli_(cli) {}
  CLI::App& cli() const { return cli_; }

  /// The topic of --help of the options that follow.
  void topic(std::string_view name);

  /// What stands on the command line without an option.
  void inputs(const std::string& name, const std::string& description,
              std::vector<std::string>& to);
  /// An option with a value that a function of yours reads.
  CLI::Option* value(const OptionName& name, const std::string& placeholder,
                     const std::string& description,
                     const std::function<void(const std::string& value)>& take);
  /// The same if it may be given several times: `take` gets all values.
  CLI::Option* repeated(const OptionName& name, const std::string& placeholder,
                        const std::string& description,
                        const std::function<void(const std::vector<std::string>& values)>& take);
  /// The same for a path, which is not empty.
  CLI::Option* path(const OptionName& name, const std::string& placeholder,
                    const std::string& description, std::string& path);
  /// An option without a value.
  CLI::Option* flag(const OptionName& name, const std::string& description, bool& is_given);
  CLI::Option* flag(const OptionName& name, const std::string& description,
                    const std::function<void()>& take);

  /// A value that is one of some names: `take` gets the position of the one given.
  CLI::Option* choice(const OptionName& name, const std::vector<std::string_view>& choices,
                      const std::string& description, const std::function<void(std::size_t)>& take);
  /// The same for values of an enum.
  template <class Enum>
  CLI::Option* choice(const OptionName& name, const std::string& description,
                      const std::function<void(Enum)>& take,
                      std::span<const Named<Enum>> choices = names_of<Enum>) {
    std::vector<std::string_view> words;
    for (const Named<Enum>& known : choices) words.push_back(known.name);
    return choice(name, words, description, [=](std::size_t i) { take(choices[i].value); });
  }
  /// The same for all values of an enum. @param to an Enum or an optional one.
  template <class Enum>
  requires std::is_enum_v<Enum> CLI::Option* choice(const OptionName& name,
                                                    const std::string& description, Enum& to) {
    return choice<Enum>(name, description, [&to](Enum given) { to = given; });
  }
  template <class Enum>
  CLI::Option* choice(const OptionName& name, const std::string& description,
                      std::optional<Enum>& to) {
    return choice<Enum>(name, description, [&to](Enum given) { to = given; });
  }

  /// Leaves out of the help what does nothing in any of these situations.
  void hide_outside(Situations situations);
  /// Those of the options that were given and that do nothing in some situations, in the order of
  /// --help.
  std::vector<GivenOption> given() const;

  /// Says where an option does something that was registered without a row.
  CLI::Option* limit(CLI::Option* option, const Scope& scope);

 private:
  CLI::App& cli_;
  std::map<const CLI::Option*, Scope> scopes_;  // of those that do nothing in some situations
};

}  // namespace ph::app
