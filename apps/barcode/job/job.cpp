// SPDX-License-Identifier: MIT
#include "apps/barcode/job/job.hpp"

#include <algorithm>

#include "apps/common/files/batch_names.hpp"

namespace ph::barcode {

bool Job::draws_tree() const {
  return std::ranges::any_of(places.plots,
                             [](const app::Plot& plot) { return plot.kind == "tree"; });
}

bool Job::writes_centroids() const {
  return places.format == BarcodeFormat::csv &&
         question.options.representatives == Representatives::cycles;
}

bool Job::is_folder_of_inputs(const std::string& path) const {
  return !reading.options.stack && app::is_folder(path);
}

bool Job::wants_part_of_one() const {
  return (sharing.part || sharing.on_ranks) && inputs.size() == 1 &&
         !is_folder_of_inputs(inputs.front());
}

bool Job::is_batch() const {
  if (sharing.part || sharing.joins || sharing.on_ranks) return false;
  if (inputs.size() > 1 || app::names_each(places.output) || app::names_each(places.report) ||
      std::ranges::any_of(places.plots, app::names_each, &app::Plot::path) ||
      std::ranges::any_of(places.surfaces, app::names_each, &Surface::path))
    return true;
  // A folder is a batch only if there is a place for its results. Otherwise it is an input that
  // cannot be read.
  const auto takes_several = [](const std::string& path) {
    return path.empty() || app::is_folder(path);
  };
  const bool has_others =
      !places.plots.empty() || !places.report.empty() || !places.surfaces.empty();
  const bool has_place = results.dry_run || results.output_format == BarcodeFormat::none ||
                         (places.output == "-" && has_others) ||
                         (places.output != "-" && takes_several(places.output));
  return has_place && takes_several(places.report) &&
         std::ranges::all_of(places.plots, takes_several, &app::Plot::path) &&
         std::ranges::all_of(places.surfaces, takes_several, &Surface::path) && !inputs.empty() &&
         is_folder_of_inputs(inputs.front());
}

}  // namespace ph::barcode
