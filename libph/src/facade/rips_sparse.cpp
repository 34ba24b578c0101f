// SPDX-License-Identifier: MIT
#include "facade/all_engines.hpp"

namespace ph::detail {

template Barcode compute<AllEngines>(const RipsFiltration<RipsLayout::sparse, 1>&, const Options&,
                                     const RunContext&);

}  // namespace ph::detail
