// SPDX-License-Identifier: MIT
#pragma once
#include "ph/run_context.hpp"
#include "plot/plot_canvas.hpp"

namespace ph::plot {

/// Bytes that to_raster needs, including writing its result as a PNG.
std::size_t raster_bytes(const Drawing& drawing);

/// Converts the drawing to RGB. @throws std::bad_alloc.
Raster to_raster(const Drawing& drawing);

}  // namespace ph::plot
