// SPDX-License-Identifier: MIT
#include "ph/detail/complex/simplex_filtration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ph/error.hpp"

namespace ph::detail {

void refuse_nan(std::span<const Index> simplex) {
  throw Error(ErrorKind::bad_data, fmt::format("simplex {}: found value nan, expected a number",
                                               fmt::join(simplex, " ")));
}

void refuse_late_face(std::span<const Index> face, double face_value, std::span<const Index> coface,
                      double coface_value) {
  throw Error(ErrorKind::bad_data,
              fmt::format("simplex {}: found value {}, expected at least {}, the value of its face "
                          "{}; if rounding is the cause, use the largest value of all faces",
                          fmt::join(coface, " "), coface_value, face_value, fmt::join(face, " ")));
}

}  // namespace ph::detail
