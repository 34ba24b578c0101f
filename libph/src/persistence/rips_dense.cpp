// SPDX-License-Identifier: MIT
#include "ph/custom.hpp"

namespace ph {

template Barcode persistence<RipsFiltration<RipsLayout::dense, 1>>(
    const RipsFiltration<RipsLayout::dense, 1>&, const Options&, const RunContext&);

}  // namespace ph
