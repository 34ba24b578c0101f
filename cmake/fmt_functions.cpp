// SPDX-License-Identifier: MIT
// Compiles all functions that users of fmt may call, once. FMT_HEADER_ONLY defines them inline, and
// -fkeep-inline-functions keeps the functions that nothing here calls.
#include <fmt/format.h>

namespace {
[[maybe_unused, gnu::used]] std::string (*const kVformat)(fmt::string_view,
                                                          fmt::format_args) = fmt::vformat;
}
