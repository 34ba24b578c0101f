// SPDX-License-Identifier: MIT
#include "rips/surfaces/lens_surfaces.hpp"

namespace ph {

template class TriangleCochain<Z2>;
template class TriangleCochain<Zp>;
template class TriangleCocycles<Z2>;
template class TriangleCocycles<Zp>;
template class LensSurfaces<Z2>;
template class LensSurfaces<Zp>;

}  // namespace ph
