// SPDX-License-Identifier: MIT
#include "ph/detail/report/page_template.hpp"

#include <fmt/format.h>

#include "ph/error.hpp"

namespace ph::report {

void require_built_in() {
  if (page_template().empty())
    throw Error(ErrorKind::not_built_in,
                fmt::format("{}: reports are not built in; build with npm, or run "
                            "scripts/viewer.sh build first",
                            mark(Setting::report)));
}

}  // namespace ph::report
