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

/// The names of an option, and the situations in which it has an effect. An example is
/// {"-o,--output", {kPoints, "points"}}.
struct OptionName {
  OptionName(const char* all) : names(all) {}  // NOLINT(google-explicit-constructor)
  OptionName(std::string all, Scope where = {}) : names(std::move(all)), scope(where) {}

  std::string names;  ///< such as "-o,--output"
  Scope scope;
};

/// Registers the options of a program. Each call states the names of an option, the situations in
/// which it has an effect, a placeholder for its value, a sentence for --help, and the destination
/// of the value. The destination must outlive `cli`. Errors of functions that read values are
/// passed on unchanged. An option that is given twice is an error, unless `repeated` registered it.
class Options {
 public:
  explicit Options(CLI::App& cli) : cli_(cli) {}
  CLI::App& cli() const { return cli_; }

  /// Begins a topic of --help, to which the options registered next belong.
  void topic(std::string_view name);

  /// Registers the inputs, which are the arguments that do not belong to an option.
  void inputs(const std::string& name, const std::string& description,
              std::vector<std::string>& to);
  /// An option with a value, which `take` reads.
  CLI::Option* value(const OptionName& name, const std::string& placeholder,
                     const std::string& description,
                     const std::function<void(const std::string& value)>& take);
  /// An option that may be given several times. `take` receives all values.
  CLI::Option* repeated(const OptionName& name, const std::string& placeholder,
                        const std::string& description,
                        const std::function<void(const std::vector<std::string>& values)>& take);
  /// An option whose value is a path that is not empty.
  CLI::Option* path(const OptionName& name, const std::string& placeholder,
                    const std::string& description, std::string& path);
  /// An option without a value.
  CLI::Option* flag(const OptionName& name, const std::string& description, bool& is_given);
  CLI::Option* flag(const OptionName& name, const std::string& description,
                    const std::function<void()>& take);

  /// An option whose value is one of several names. `take` receives the position of the given name.
  CLI::Option* choice(const OptionName& name, const std::vector<std::string_view>& choices,
                      const std::string& description, const std::function<void(std::size_t)>& take);
  /// An option whose value is one of an enum's names. `take` receives the value of the enum.
  template <class Enum>
  CLI::Option* choice(const OptionName& name, const std::string& description,
                      const std::function<void(Enum)>& take,
                      std::span<const Named<Enum>> choices = names_of<Enum>) {
    std::vector<std::string_view> words;
    for (const Named<Enum>& known : choices) words.push_back(known.name);
    return choice(name, words, description, [=](std::size_t i) { take(choices[i].value); });
  }
  /// An option for all values of an enum. @param to receives the value: an Enum or an optional
  /// Enum.
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

  /// Hides from --help the options that have no effect in any of these situations.
  void hide_outside(Situations situations);
  /// The given options that have no effect in some situations, in the order of --help.
  std::vector<GivenOption> given() const;

  /// Sets the situations in which an option has an effect, for an option that was registered
  /// directly with CLI11.
  CLI::Option* limit(CLI::Option* option, const Scope& scope);

 private:
  CLI::App& cli_;
  // The scopes of options that have no effect in some situations.
  std::map<const CLI::Option*, Scope> scopes_;
};

}  // namespace ph::app
