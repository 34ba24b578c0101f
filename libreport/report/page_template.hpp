// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>

namespace ph::report {

/// Where the payload goes: in the template exactly once.
inline constexpr std::string_view kPayloadMarker = "<!--ph:payload-->";

/// The page without its payload, as viewer/ builds it; empty where it is not built in.
std::string_view page_template();

/// For whoever wants a report, before anything is computed. @throws Error (not_built_in) "option:
/// …" if there is no template.
void require_built_in();

}  // namespace ph::report
