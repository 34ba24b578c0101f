// SPDX-License-Identifier: MIT
#include "ph/engine/lens_surfaces.hpp"

namespace ph {

template class LinkCochain<Z2>;
template class LinkCochain<Zp>;
template class TriangleCocycles<Z2>;
template class TriangleCocycles<Zp>;
template class LensSurfaces<Z2>;
template class LensSurfaces<Zp>;

}  // namespace ph
