// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/barcode/job/job.hpp"
#include "apps/common/run/session.hpp"

namespace ph::barcode {

/// The files that a run writes. A file that cannot be created is reported before the computation.
class Outputs {
 public:
  /// @throws Error (cannot_create).
  explicit Outputs(const Places& places);
  /// Writes and completes all files except the report. @param data the loops and p-values of bars.
  /// @param look the look of the plots. @param trees the plots of merge trees, in their order.
  void write(const Barcode& bars, const BarData& data, const PlotOptions& look,
             std::span<const std::string> trees, const RunContext& context);
  /// Writes the surfaces of an alpha complex. They are completed with the other files.
  /// @param ids the numbers of the points in the input; if empty, they are the indices of the
  /// points.
  void write_surfaces(const Alpha& alpha, PointsView points, std::span<const Index> ids,
                      const RunContext& context);
  /// Precondition: the job has a report.
  app::Output& report() { return *report_; }

 private:
  const Places& places_;
  std::optional<app::Output> barcode_, report_;
  std::vector<app::Output> plots_, surfaces_;
};

/// The look of the plots of an image. For superlevel sets, axes are labelled with the values of the
/// image instead of their negatives.
PlotOptions look_of(PlotOptions look, bool superlevel);

/// Warns about dimensions that were requested for plots but have no bars.
void note_absent_dims(const Barcode& bars, const PlotOptions& look, app::Session& session);

}  // namespace ph::barcode
