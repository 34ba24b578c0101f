// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/common/run/session.hpp"
#include "apps/segment/arguments/arguments.hpp"
#include "ph/io/write.hpp"
#include "ph/scene_report.hpp"

namespace ph::segment {

/// The facts that files state in addition to the segmentation.
struct RunInfo {
  std::string program;      ///< the name and the version
  std::string input;        ///< the path of the input
  double read_seconds = 0;  ///< the wall-clock time of reading the input
  bool from_tree = false;   ///< true if a stored tree was cut
  /// The name of each segment in the files. If empty, the name of a segment is its label.
  std::vector<std::uint32_t> numbers = {};
  /// For each segment, its homology, or nothing if memory did not suffice for it. The list is empty
  /// if signatures were not requested.
  std::vector<std::optional<Barcode>> signatures = {};
  // The following members are for the report.
  std::string sha256 = {};                 ///< the hash of the input
  std::vector<std::string> warnings = {};  ///< warnings that were printed

  std::uint32_t number_of(std::uint32_t label) const {
    return label == 0 || numbers.empty() ? label : numbers[label - 1];
  }
};

/// The origin of the barcode of a segmentation, as files state it.
BarcodeInfo barcode_info(const Segmentation& segmentation, const RunInfo& info);

/// The files that the command line requests. They are opened before the computation. At the end,
/// each file is complete or absent.
class Outputs {
 public:
  /// @throws Error (usage) on an unknown extension; Error (cannot_create).
  explicit Outputs(const Arguments& arguments);

  /// @throws Error (usage) if a file needs rows and columns and the cloud is unorganised.
  void require_suitable(Index height) const;
  /// Writes and completes all files. @param cloud null if a stored tree was cut.
  void write(const Cloud* cloud, const Segmentation& segmentation, const RunInfo& info,
             const RunContext& context);

 private:
  struct File {
    OutputKind kind;
    app::Output output;
    const app::Plot* plot;  ///< the plot, if the file is a plot
  };
  void write_file(File& file, const Cloud* cloud, const Segmentation& segmentation,
                  const RunInfo& info, const RunContext& context) const;
  std::string plot(const app::Plot& plot, const Cloud* cloud, const Segmentation& s,
                   const RunInfo& info, const RunContext& context) const;
  report::ScenePage report_page(const Cloud* cloud, const Segmentation& s,
                                const RunInfo& info) const;

  const Arguments& arguments_;
  std::vector<File> files_;
};

}  // namespace ph::segment
