// SPDX-License-Identifier: MIT
#include "rips/surfaces/link_surfaces.hpp"

namespace ph {

template class TriangleCochain<Z2>;
template class TriangleCochain<Zp>;
template class TriangleCocycles<Z2>;
template class TriangleCocycles<Zp>;
template class LinkSurfaces<Z2>;
template class LinkSurfaces<Zp>;

}  // namespace ph
