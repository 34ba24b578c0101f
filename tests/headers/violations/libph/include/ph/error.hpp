// SPDX-License-Identifier: MIT
#pragma once

namespace ph {

enum class Setting { none, unheard_of };

inline constexpr const char* hint = "--nan drop leaves it out";

}  // namespace ph
