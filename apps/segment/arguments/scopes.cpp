// SPDX-License-Identifier: MIT
#include "apps/segment/arguments/scopes.hpp"

#include <fmt/format.h>

#include <array>

namespace ph::segment {

void require_input(std::span<const app::GivenOption> given, Situation input) {
  app::require_in_scope(given, input,
                        input == kCloud ? "a cloud"
                        : input == kDepthImage
                            ? "a depth image"
                            : "a stored tree, which keeps the options it was made with; --cut, "
                              "--min-part, --min-size, --objects and --parts cut it "
                              "anew, --labels writes the labels of its points");
}

void require_method(std::span<const app::GivenOption> given, Method method) {
  constexpr std::array kMethods{kSurface, kPaper, kSupervoxels};
  static_assert(static_cast<int>(Method::surface) == 0 && static_cast<int>(Method::paper) == 1 &&
                static_cast<int>(Method::supervoxels) == 2);
  const auto index = static_cast<std::size_t>(method);
  app::require_in_scope(given, kMethods[index], fmt::format("--method {}", kMethodNames[index]));
}

void require_plane(std::span<const app::GivenOption> given, bool plane) {
  app::require_in_scope(given, plane ? kPlane : kNoPlane, "--plane off");
}

}  // namespace ph::segment
