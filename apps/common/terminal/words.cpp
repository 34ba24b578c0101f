// SPDX-License-Identifier: MIT
#include "apps/common/terminal/words.hpp"

#include <algorithm>

namespace ph::app {
namespace {

std::string option_with(Setting setting, std::string_view value) {
  std::string text = "--" + option_name(setting);
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

}  // namespace ph::app
