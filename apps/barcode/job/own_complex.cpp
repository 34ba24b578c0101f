// SPDX-License-Identifier: MIT
#include "apps/barcode/job/own_complex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "ph/error.hpp"

namespace ph::barcode {
namespace {

std::vector<OwnComplex>& added() {
  static std::vector<OwnComplex> complexes;
  return complexes;
}

std::vector<std::string_view>& names() {
  static std::vector<std::string_view> all{"auto",       "rips",  "cubical",       "explicit",
                                           "lower-star", "alpha", "delaunay-cech", "delaunay-rips"};
  return all;
}

}  // namespace

void add_complex(OwnComplex complex) {
  if (std::ranges::find(names(), complex.name) != names().end())
    throw Error(ErrorKind::usage, fmt::format("complex {}: this name is taken", complex.name));
  names().push_back(complex.name);
  added().push_back(std::move(complex));
}

std::span<const OwnComplex> own_complexes() { return added(); }
std::span<const std::string_view> complex_names() { return names(); }

}  // namespace ph::barcode
