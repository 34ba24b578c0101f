// SPDX-License-Identifier: MIT
// Compiles once all functions of fmt that users of fmt call: FMT_HEADER_ONLY defines them inline,
// and -fkeep-inline-functions keeps those that nothing here calls.
#include <fmt/format.h>

namespace {
[[maybe_unused, gnu::used]] std::string (*const kVformat)(fmt::string_view,
                                                          fmt::format_args) = fmt::vformat;
}
