// SPDX-License-Identifier: MIT
#include "ph/io/plot.hpp"

#include <sstream>
#include <utility>

#include "libph/src/plot/plot_canvas.hpp"
#include "ph/error.hpp"
#if PH_WITH_FREETYPE
#include "libph/src/plot/plot_font.hpp"
#endif

namespace ph {
namespace {

#if PH_WITH_FREETYPE
template <class Draw>
std::string png_of(const RunContext& context, const PlotOptions& options, Draw&& draw) {
  const plot::Drawing drawing = plot::fitted(draw(), options);
  const MemoryClaim claim(context.memory, plot::raster_bytes(drawing));
  std::ostringstream out;
  out.exceptions(std::ios::badbit);  // otherwise the stream would hide a lack of memory
  write_png(out, to_raster(drawing));
  return std::move(out).str();
}
#else
template <class Draw>
std::string png_of(const RunContext&, const PlotOptions&, Draw&&) {
  throw Error(ErrorKind::not_built_in, "PNG plots are not built in; use SVG");
}
#endif

}  // namespace

std::string png_plot_support() {
#if PH_WITH_FREETYPE
  return plot::Font::name();
#else
  return {};
#endif
}

std::string png_plot(const Barcode& barcode, const PlotOptions& options,
                     const RunContext& context) {
  return png_of(context, options, [&] { return plot::draw(barcode, options); });
}

std::string png_plot(std::span<const Branch> tree, const PlotOptions& options,
                     const RunContext& context) {
  return png_of(context, options, [&] { return plot::draw_tree(tree, options); });
}

std::string png_plot(const ColouredPicture& picture, const PlotOptions& options,
                     const RunContext& context) {
  return png_of(context, options, [&] { return plot::draw_coloured(picture, options); });
}

}  // namespace ph
