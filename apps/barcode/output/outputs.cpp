// SPDX-License-Identifier: MIT
#include "apps/barcode/output/outputs.hpp"

#include <fmt/format.h>

namespace ph::barcode {

namespace {

/// The bars of some dimensions, with everything that is known about them.
struct Chosen {
  Barcode bars;
  std::vector<BarLoops> loops;
  std::vector<double> p_values;
  std::vector<double> centroids;  ///< row after row

  Chosen(const Barcode& all, const BarData& data, std::span<const int> dims)
      : bars(all.cell_kind()) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (std::ranges::find(dims, all[i].dim) == dims.end()) continue;
      add(all, i);
      if (!data.loops.empty()) loops.push_back(data.loops[i]);
      if (!data.p_values.empty()) p_values.push_back(data.p_values[i]);
      for (Index axis = 0; axis < data.centroids.cols(); ++axis)
        centroids.push_back(data.centroids(static_cast<Index>(i), axis));
    }
    BarcodeInfo info = all.info();
    info.dims.assign(dims.begin(), dims.end());
    bars.set_info(std::move(info));
  }

 private:
  void add(const Barcode& all, std::size_t i) {
    const auto death = all.death_cell(i);
    bars.add(all[i], all.birth_cell(i).numbers, death ? death->numbers : std::span<const Index>());
    if (all.representatives() == Representatives::none) return;
    const InputChain chain = all.representative(i);
    std::vector<Index> numbers;
    std::vector<std::int64_t> coefficients;
    for (std::size_t k = 0; k < chain.size(); ++k) {
      const std::span<const Index> cell = chain.cell(k).numbers;
      numbers.insert(numbers.end(), cell.begin(), cell.end());
      coefficients.push_back(chain.coefficient(k));
    }
    bars.set_representative(all.representatives(), numbers, coefficients);
    if (all.representatives() != Representatives::voxels) return;
    const std::size_t begin = bars.store_voxels(all.voxels(i));
    bars.set_voxels({begin, begin + all.voxels(i).size()}, all.birth_voxel(i), all.death_voxel(i));
  }
};

}  // namespace

Outputs::Outputs(const Places& places) : places_(places) {
  if (places.format != BarcodeFormat::none) barcode_.emplace(places.output);
  for (const app::Plot& plot : places.plots) plots_.emplace_back(plot.path);
  for (const Surface& surface : places.surfaces) surfaces_.emplace_back(surface.path);
  if (!places.report.empty()) report_.emplace(places.report);
}

void Outputs::write_surfaces(const Alpha& alpha, PointsView points, std::span<const Index> ids,
                             const RunContext& context) {
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const Surface& surface = places_.surfaces[i];
    write_surface(
        surfaces_[i].file(), points,
        surface.is_wrap ? wrap(alpha, surface.value, context) : alpha_shape(alpha, surface.value),
        surface_format_of_path(surface.path).value_or(SurfaceFormat::ply), ids);
  }
}

void Outputs::write(const Barcode& bars, const BarData& data, const PlotOptions& look,
                    std::span<const std::string> trees, const RunContext& context) {
  auto tree = trees.begin();
  for (std::size_t i = 0; i < plots_.size(); ++i) {
    const app::Plot& plot = places_.plots[i];
    const auto kind = plot_kind_named(plot.kind);
    PlotOptions options = look;
    options.kind = kind.value_or(options.kind);
    plots_[i].write(kind ? app::drawn(plot, bars, options, context) : *tree++);
  }
  // Drawing a picture may run out of memory. Therefore no file is completed before all pictures are
  // drawn.
  if (barcode_) {
    if (look.dims.empty()) {
      write_barcode(barcode_->file(), bars, places_.format, data);
    } else {
      const Chosen chosen(bars, data, look.dims);
      write_barcode(barcode_->file(), chosen.bars, places_.format,
                    {.loops = chosen.loops,
                     .p_values = chosen.p_values,
                     .centroids = PointsView(chosen.centroids.data(), std::ssize(chosen.bars),
                                             data.centroids.cols())});
    }
    barcode_->commit();
  }
  for (app::Output& plot : plots_) plot.commit();
  for (app::Output& surface : surfaces_) surface.commit();
}

PlotOptions look_of(PlotOptions look, bool superlevel) {
  if (!superlevel) return look;
  look.negated = true;
  look.value_label = "Value, falling";
  return look;
}

void note_absent_dims(const Barcode& bars, const PlotOptions& look, app::Session& session) {
  for (const int dim : look.dims) {
    bool is_there = false;
    for (std::size_t i = 0; i < bars.size() && !is_there; ++i) is_there = bars[i].dim == dim;
    if (!is_there) session.note(fmt::format("--dims {}: there are no bars of this dimension", dim));
  }
}

}  // namespace ph::barcode
