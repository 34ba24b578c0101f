// SPDX-License-Identifier: MIT
#include "ph/io/svg_plot.hpp"

#include "ph/core/error.hpp"
#include "plot_canvas.hpp"

namespace ph {
namespace plot {

Drawing draw(const Barcode& barcode, const PlotOptions& options) {
  switch (options.kind) {
    case PlotKind::barcode:
      return draw_barcode(barcode, options);
    case PlotKind::diagram:
      return draw_diagram(barcode, options);
    case PlotKind::betti:
      return draw_betti(barcode, options);
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
  return to_svg(plot::draw(barcode, options));
}

std::string svg_plot(std::span<const Branch> tree, const PlotOptions& options) {
  return to_svg(plot::draw_tree(tree, options));
}

std::string svg_plot(const ColouredPicture& picture, const PlotOptions& options) {
  return to_svg(plot::draw_coloured(picture, options));
}

}  // namespace ph
