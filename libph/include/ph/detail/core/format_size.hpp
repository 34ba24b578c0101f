// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace ph {

/// A size in bytes in readable form: "1.5 GiB".
std::string format_size(double bytes);

}  // namespace ph
