// SPDX-License-Identifier: MIT
#include "apps/common/terminal/words.hpp"

#include <algorithm>
#include <utility>

namespace ph::app {
namespace {

std::vector<std::string>& known_options() {
  static std::vector<std::string> names;
  return names;
}

std::string option_with(Setting setting, std::string_view value) {
  std::string text = "--" + option_name(setting);
  const std::vector<std::string>& known = known_options();
  if (!known.empty() && std::ranges::find(known, text) == known.end()) return {};
  if (!value.empty()) (text += ' ') += alternatives(value);
  return text;
}

}  // namespace

std::string option_name(Setting setting) {
  if (setting == Setting::spacing) return "supervoxels";
  if (setting == Setting::first_meeting) return "explain";
  if (setting == Setting::most_supports) return "plane";
  std::string name(name_of(setting));
  std::ranges::replace(name, '_', '-');
  return name;
}

const Words kWords{&option_with};

void set_known_options(std::vector<std::string> names) { known_options() = std::move(names); }

}  // namespace ph::app
