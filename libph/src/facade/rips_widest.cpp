// SPDX-License-Identifier: MIT
#include "facade/all_engines.hpp"

namespace ph::detail {

template Barcode compute<AllEngines>(const RipsFiltration<RipsLayout::any, 4>&, const Options&,
                                     const RunContext&);

}  // namespace ph::detail
