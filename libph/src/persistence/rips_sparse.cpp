// SPDX-License-Identifier: MIT
#include "ph/persistence.hpp"

namespace ph {

template Barcode persistence<RipsFiltration<RipsLayout::sparse, 1>>(
    const RipsFiltration<RipsLayout::sparse, 1>&, const Options&, const RunContext&);

}  // namespace ph
