// SPDX-License-Identifier: MIT
#include "rips/sweep/lens_sweep.hpp"

namespace ph {

template class LensSweep<Z2>;
template class LensSweep<Zp>;

}  // namespace ph
