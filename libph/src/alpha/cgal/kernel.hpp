// SPDX-License-Identifier: MIT
#pragma once
// Only this folder includes CGAL. A program that is linked with CGAL falls under the GPL.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "libph/src/alpha/sites/sites.hpp"

namespace ph::alpha {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

inline Kernel::Point_3 point_of(const Vector<double>& p) { return {p.x, p.y, p.z}; }

/// Sites in the order of a biased randomised insertion (Amenta, Choi, Rote, Incremental
/// constructions con BRIO, 2003). Each round has about eight times as many sites as the previous
/// round, and follows a path through its sites.
std::pmr::vector<std::uint32_t> insertion_order(const Sites& sites,
                                                std::pmr::memory_resource* memory);

}  // namespace ph::alpha
