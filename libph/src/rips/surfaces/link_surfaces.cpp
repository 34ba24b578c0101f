// SPDX-License-Identifier: MIT
#include "libph/src/rips/surfaces/link_surfaces.hpp"

namespace ph {

template class TriangleCochain<Z2>;
template class TriangleCochain<Zp>;
template class LivingCocycles<TriangleCochain<Z2>>;
template class LivingCocycles<TriangleCochain<Zp>>;
template class LinkSurfaces<Z2>;
template class LinkSurfaces<Zp>;

}  // namespace ph
