// SPDX-License-Identifier: MIT
#include "ph/io/plot.hpp"

#include "libph/src/plot/plot_canvas.hpp"
#include "ph/error.hpp"

namespace ph {
namespace plot {

Drawing draw(const Barcode& barcode, const PlotOptions& options) {
  const bool is_part = !options.dims.empty() || options.axis.low || options.axis.high;
  std::size_t beyond = 0;
  const Barcode part = is_part ? shown_of(barcode, options, beyond) : Barcode();
  const Barcode& shown = is_part ? part : barcode;
  switch (options.kind) {
    case PlotKind::barcode:
      return draw_barcode(shown, beyond, options);
    case PlotKind::diagram:
      return draw_diagram(shown, beyond, options);
    case PlotKind::betti:
      return draw_betti(shown, beyond, options);
  }
  throw Error(ErrorKind::internal, "an unknown kind of plot");
}

}  // namespace plot

std::optional<PlotKind> plot_kind_named(std::string_view name) {
  if (name == "barcode") return PlotKind::barcode;
  if (name == "diagram") return PlotKind::diagram;
  if (name == "betti") return PlotKind::betti;
  return std::nullopt;
}

std::string svg_plot(const Barcode& barcode, const PlotOptions& options) {
  return to_svg(plot::fitted(plot::draw(barcode, options), options));
}

std::string svg_plot(std::span<const Branch> tree, const PlotOptions& options) {
  return to_svg(plot::fitted(plot::draw_tree(tree, options), options));
}

std::string svg_plot(const ColouredPicture& picture, const PlotOptions& options) {
  return to_svg(plot::fitted(plot::draw_coloured(picture, options), options));
}

}  // namespace ph
