// SPDX-License-Identifier: MIT
#include <CGAL/version.h>

#include "ph/alpha.hpp"

namespace ph {

std::string alpha_support() { return "CGAL " CGAL_VERSION_STR; }

}  // namespace ph
