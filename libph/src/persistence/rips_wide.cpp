// SPDX-License-Identifier: MIT
#include "ph/custom.hpp"

namespace ph {

template Barcode persistence<RipsFiltration<RipsLayout::any, 2>>(
    const RipsFiltration<RipsLayout::any, 2>&, const Options&, const RunContext&);

}  // namespace ph
