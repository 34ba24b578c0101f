// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "barcode/run.hpp"

namespace ph::barcode {

/// The files that a run writes. What cannot be created is said before anything is computed.
class Outputs {
 public:
  /// @throws Error (cannot_create).
  explicit Outputs(const Job& job);
  /// Writes and completes all but the report.
  /// @param look of the plots. @param trees those of merge trees, in their order.
  void write(const Barcode& bars, const BarcodeInfo& info, const PlotOptions& look,
             std::span<const std::string> trees, const RunContext& context);
  /// Writes the surfaces of an alpha complex; they are completed with the rest.
  /// @param ids the numbers of the points in the input; empty: their own.
  void write_surfaces(const Alpha& alpha, PointsView points, std::span<const Index> ids,
                      const RunContext& context);
  /// Precondition: the job has one.
  app::Output& report() { return *report_; }

 private:
  const Job& job_;
  std::optional<app::Output> barcode_, report_;
  std::vector<app::Output> plots_, surfaces_;
};

/// How plots look: those of superlevel sets name the values of the image.
PlotOptions look_of(PlotOptions look, bool superlevel);

/// Says which dimensions that plots were asked to show have no bars.
void note_absent_dims(const Barcode& bars, const PlotOptions& look, app::Session& session);

}  // namespace ph::barcode
