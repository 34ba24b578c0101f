// SPDX-License-Identifier: MIT
#include "apps/vectorise/make_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "ph/error.hpp"

namespace ph::vectorise {
namespace {

using Spans = std::vector<std::span<const Bar>>;

constexpr std::size_t kPoints = 100, kPixels = 20, kCentres = 10;

Grid grid_of(const Spans& diagrams, const std::optional<AxisArgument>& given) {
  const std::size_t points = given ? given->count : kPoints;
  if (given && given->range) return {(*given->range)[0], (*given->range)[1], points};
  return fit_grid(diagrams, points);
}

ImageFrame frame_of(const Spans& diagrams, const Arguments& arguments) {
  const auto& [births, lengths] = std::pair(arguments.grid, arguments.length_grid);
  const std::size_t columns = births ? births->count : kPixels,
                    rows = lengths ? lengths->count : columns;
  ImageFrame frame = fit_image_frame(diagrams, columns, rows);
  if (births && births->range) {
    frame.births.lo = (*births->range)[0];
    frame.births.hi = (*births->range)[1];
  }
  if (lengths && lengths->range) {
    frame.lengths.lo = (*lengths->range)[0];
    frame.lengths.hi = (*lengths->range)[1];
  }
  return frame;
}

double width_of(const PixelRange& range) { return range.hi - range.lo; }

Block block_of(const Fit& fit, int dim, const Spans& diagrams, const Arguments& arguments,
               const RunContext& context) {
  Block block;
  block.dim = dim;
  switch (fit.kind) {
    case Kind::betti:
    case Kind::landscape:
    case Kind::silhouette:
    case Kind::life_entropy:
      block.grid = grid_of(diagrams, arguments.grid);
      break;
    case Kind::image:
      block.frame = frame_of(diagrams, arguments);
      // mutant: fit-sigma
      block.sigma = arguments.sigma.value_or(
          std::max(width_of(block.frame.births), width_of(block.frame.lengths)) / 20);
      break;
    case Kind::atol: {
      AtolOptions options = arguments.atol;
      options.centres = arguments.count.value_or(kCentres);
      try {
        block.atol = fit_atol(diagrams, options, context);
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::bad_data) throw;
        const Error of_dim = about_input(error, fmt::format("H{}", dim));
        throw Error(error.kind(),
                    fmt::format("{}; --count K sets another number", of_dim.marked()));
      }
      break;
    }
    default:
      break;
  }
  return block;
}

std::vector<int> dims_of(const std::vector<Barcode>& barcodes) {
  std::set<int> dims;
  for (const Barcode& bars : barcodes)
    for (const Bar& bar : bars) dims.insert(bar.dim);
  return {dims.begin(), dims.end()};
}

}  // namespace

Fit fit_of(const Arguments& arguments) {
  Fit fit;
  fit.kind = arguments.kind;
  const bool is_euler = fit.kind == Kind::euler;
  fit.infinite = arguments.infinite.value_or(
      InfiniteRule{is_euler ? InfiniteRule::Rule::keep : InfiniteRule::Rule::drop, 0});
  fit.layers = arguments.layers;
  if (fit.kind == Kind::lengths) fit.count = arguments.count.value_or(fit.count);
  fit.power = arguments.power;
  fit.normalised = arguments.normalised;
  fit.cubical = arguments.cubical;
  return fit;
}

void add_blocks(Fit& fit, const std::vector<Barcode>& barcodes,
                const std::vector<std::string>& names, const Arguments& arguments,
                std::size_t& dropped, const RunContext& context) {
  const std::vector<int> dims = arguments.dims.empty() ? dims_of(barcodes) : arguments.dims;
  if (dims.empty())
    throw Error(ErrorKind::bad_data,
                "found no bars in any input, expected some; --dims sets the dimensions of a "
                "vector without bars");
  for (const int dim : dims) {
    std::vector<std::vector<Bar>> diagrams;
    for (std::size_t i = 0; i < barcodes.size(); ++i)
      diagrams.push_back(bars_of(fit, barcodes[i].bars(dim), names[i], dropped));
    const Spans spans(diagrams.begin(), diagrams.end());
    fit.blocks.push_back(block_of(fit, dim, spans, arguments, context));
  }
}

void add_euler_block(Fit& fit, std::span<const StepFunction> curves, const Arguments& arguments) {
  // The first two changes and the last change of each curve, as bars that never end. The fit uses
  // the births of these bars.
  std::vector<Bar> changes;
  for (const StepFunction& curve : curves) {
    const std::size_t count = curve.at.size();
    // The range of a curve that begins at -infinity starts at its next change.
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}, count - 1})
      if (k < count) changes.push_back({0, curve.at[k], kInfinity});  // mutant: euler-change
  }
  fit.blocks.emplace_back().grid = grid_of({changes}, arguments.grid);
}

}  // namespace ph::vectorise
