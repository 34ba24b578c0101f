// SPDX-License-Identifier: MIT
#include "libph/src/rips/volumes/link_volumes.hpp"

namespace ph {

template class LinkPrimitives<Z2>;
template class LinkPrimitives<Zp>;
template class TetrahedronCochain<Z2>;
template class TetrahedronCochain<Zp>;
template class LivingCocycles<TetrahedronCochain<Z2>>;
template class LivingCocycles<TetrahedronCochain<Zp>>;
template class LinkVolumes<Z2>;
template class LinkVolumes<Zp>;

}  // namespace ph
