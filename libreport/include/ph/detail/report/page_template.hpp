// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>

namespace ph::report {

/// The marker for the payload; the template contains it exactly once.
inline constexpr std::string_view kPayloadMarker = "<!--ph:payload-->";

/// The page without its payload, as viewer/ builds it; empty if this build has none.
std::string_view page_template();

/// Must be called before the computation if a report is wanted. @throws Error (not_built_in)
/// "option: …" if there is no template.
void require_built_in();

}  // namespace ph::report
