// SPDX-License-Identifier: MIT
#include "segment/arguments/option_scopes.hpp"

#include <fmt/format.h>

#include <array>

namespace ph::segment {
namespace {

using app::OptionScope;

constexpr app::Situations kScene = kCloud | kDepthImage, kAnyInput = kScene | kStoredTree,
                          kBySurface = kSurface | kSupervoxels, kAnyMethod = kPaper | kBySurface,
                          kAnyPlane = kPlane | kNoPlane;

constexpr std::string_view kOfScenes = "clouds and depth images",
                           kOfBoth = "--method surface and supervoxels";

/// If input, method and plane all restrict an option, `meant_for` names the rarest restriction.
constexpr std::array kScopes{
    OptionScope{"color", kDepthImage | kAnyMethod | kAnyPlane, "depth images"},
    OptionScope{"camera", kDepthImage | kAnyMethod | kAnyPlane, "depth images"},
    OptionScope{"intrinsics", kDepthImage | kAnyMethod | kAnyPlane, "depth images"},
    OptionScope{"depth-scale", kDepthImage | kAnyMethod | kAnyPlane, "depth images"},
    OptionScope{"allow-empty", kCloud | kAnyMethod | kAnyPlane, "clouds"},
    OptionScope{"max-range", kScene | kAnyMethod | kAnyPlane, kOfScenes},
    OptionScope{"crop", kScene | kAnyMethod | kAnyPlane, kOfScenes},
    OptionScope{"plane", kScene | kAnyMethod | kAnyPlane, kOfScenes},
    OptionScope{"plane-distance", kScene | kAnyMethod | kPlane, "scenes with --plane on"},
    OptionScope{"plane-noise", kScene | kBySurface | kPlane,
                "scenes with --plane on and --method surface or supervoxels"},
    OptionScope{"viewpoint", kScene | kAnyMethod | kAnyPlane, kOfScenes},
    OptionScope{"method", kScene | kAnyMethod | kAnyPlane, kOfScenes},
    OptionScope{"supervoxels", kScene | kSupervoxels | kAnyPlane, kOfScenes},
    OptionScope{"voxel", kScene | kAnyMethod | kAnyPlane, kOfScenes},
    OptionScope{"min-persistence", kScene | kBySurface | kAnyPlane, kOfBoth},
    OptionScope{"distance", kScene | kPaper | kAnyPlane, "--method paper"},
    OptionScope{"steps", kScene | kPaper | kAnyPlane, "--method paper"},
    OptionScope{"no-check", kScene | kAnyMethod | kAnyPlane, kOfScenes},
    OptionScope{"min-part", kAnyInput | kBySurface | kAnyPlane, kOfBoth},
    OptionScope{"min-seam", kAnyInput | kSurface | kAnyPlane, "--method surface"},
    OptionScope{"objects", kAnyInput | kSurface | kAnyPlane, "--method surface"},
    OptionScope{"parts", kAnyInput | kSurface | kAnyPlane, "--method surface"},
    OptionScope{"output", kScene | kAnyMethod | kAnyPlane, kOfScenes},
    OptionScope{"coloured", kScene | kAnyMethod | kAnyPlane, kOfScenes},
    OptionScope{"picture", kScene | kAnyMethod | kAnyPlane, kOfScenes},
};

}  // namespace

std::span<const OptionScope> option_scopes() { return kScopes; }

void require_input(std::span<const OptionScope* const> given, Situation input) {
  app::require_in_scope(given, input,
                        input == kCloud ? "a cloud"
                        : input == kDepthImage
                            ? "a depth image"
                            : "a stored tree, which was made with what it was made with; --cut, "
                              "--min-part, --min-size, --min-seam, --objects and --parts cut it "
                              "anew, --labels writes the labels of its points");
}

void require_method(std::span<const OptionScope* const> given, Method method) {
  constexpr std::array kMethods{kSurface, kPaper, kSupervoxels};
  static_assert(static_cast<int>(Method::surface) == 0 && static_cast<int>(Method::paper) == 1 &&
                static_cast<int>(Method::supervoxels) == 2);
  const auto index = static_cast<std::size_t>(method);
  app::require_in_scope(given, kMethods[index], fmt::format("--method {}", kMethodNames[index]));
}

void require_plane(std::span<const OptionScope* const> given, bool plane) {
  app::require_in_scope(given, plane ? kPlane : kNoPlane, "--plane off");
}

}  // namespace ph::segment
