// SPDX-License-Identifier: MIT
#include "ph/custom.hpp"

namespace ph {

template Barcode persistence<Cubical>(const Cubical&, const Options&, const RunContext&);

}  // namespace ph
