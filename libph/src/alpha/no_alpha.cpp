// SPDX-License-Identifier: MIT
// Replaces the library ph::alpha in builds without CGAL.
#include "libph/src/alpha/alpha_lazy.hpp"
#include "ph/error.hpp"

namespace ph {

std::string alpha_support() { return ""; }

Alpha::Alpha(PointsView, const AlphaOptions&, const RunContext&) {
  throw Error(
      ErrorKind::not_built_in,
      "alpha complexes are not built in: they need CGAL (Debian: libcgal-dev), and a program that "
      "contains them falls under the GPL");
}

}  // namespace ph
