// SPDX-License-Identifier: MIT
#include "libph/src/rips/edge_link_sweep.hpp"

namespace ph {

template class EdgeLinkSweep<Z2>;
template class EdgeLinkSweep<Zp>;

}  // namespace ph
