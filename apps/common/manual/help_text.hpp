// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "apps/common/manual/option_text.hpp"

namespace ph::app {

/// The topic that --help shows without an argument.
inline constexpr std::string_view kUsual = "usual";

/// All arguments of --help. They are the topics of the program, `all`, and the outputs for other
/// programs, which are `man`, `markdown`, and the shells.
std::vector<std::string_view> help_topics(const Manual& manual);

/// The answer to `--help TOPIC`. @throws Error (usage) on an unknown topic, with the list of
/// topics.
std::string help_text(const Described& program, std::string_view topic);

}  // namespace ph::app
