// SPDX-License-Identifier: MIT
// Must not compile: nobody has said which complex.
#include "ph/ph.hpp"

ph::Barcode bars(const ph::Points& points) { return ph::persistence(points); }
