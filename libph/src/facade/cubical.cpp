// SPDX-License-Identifier: MIT
#include "facade/all_engines.hpp"

namespace ph::detail {

template Barcode compute<AllEngines>(const Cubical&, const Options&, const RunContext&);

}  // namespace ph::detail
