// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "apps/segment/arguments/arguments.hpp"

namespace ph::segment {

std::vector<std::string> idle_options(const Arguments& a) {
  std::vector<std::string> texts;
  if (a.common.threads > 0 && !a.signatures)  // mutant: idle-threads
    texts.emplace_back("--threads does nothing: everything but --signatures runs on one thread");
  if (!a.image.colour.empty() && !a.files.show(&OutputOption::shows_colours)) {
    texts.emplace_back(
        "--color does nothing: no output shows colours; --output, --coloured, --picture, --report "
        "and plots of the cloud do");
  }
  if (a.stable_labels && !a.files.show(&OutputOption::shows_labels))
    texts.emplace_back("--stable-labels does nothing: no output shows labels");
  const bool has_noise = std::ranges::any_of(
      a.given, [](const app::GivenOption& option) { return option.name == "plane-noise"; });
  const SegmentOptions& o = a.options;
  if (has_noise && o.noise_floor() < o.plane_noise) {
    texts.push_back(
        fmt::format("--plane-noise does nothing: --plane-distance {} is smaller and "
                    "replaces it",
                    *o.plane_distance));
  }
  return texts;
}

}  // namespace ph::segment
