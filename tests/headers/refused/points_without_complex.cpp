// SPDX-License-Identifier: MIT
// Must not compile, because no complex of the points is named.
#include "ph/ph.hpp"

ph::Barcode bars(const ph::Points& points) { return ph::persistence(points); }
