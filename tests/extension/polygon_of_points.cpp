// SPDX-License-Identifier: MIT
// Registers the complex with the program.
#include "apps/barcode/job/own_complex.hpp"
#include "tests/extension/polygon.hpp"

namespace {

const bool kIsAdded =
    (ph::barcode::add_complex({"polygon", "points joined in their order",
                               [](ph::PointsView points, const ph::RunContext& context) {
                                 return ph::listed(Polygon(points), context);
                               }}),
     true);

}  // namespace
