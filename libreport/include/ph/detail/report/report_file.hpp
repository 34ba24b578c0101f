// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ph/detail/image/cubical_image.hpp"
#include "ph/detail/report/array_block.hpp"
#include "ph/detail/report/metadata.hpp"
#include "ph/run_context.hpp"

namespace ph::report {

/// A report that is being written: the page up to the marker, the metadata, arrays in any order,
/// the rest of the page. docs/reference/report-format.md describes each array. All functions throw
/// Error (cancelled) and the errors of the sink.
class ReportFile {
 public:
  /// @throws Error (not_built_in) if this build has no page.
  ReportFile(const Sink& sink, const Metadata& metadata, const RunContext& context);
  template <ArrayNumber T>
  void add(std::string_view name, std::span<const T> numbers, const ArrayForm& form = {}) {
    write_array(sink_, raw_array(name, numbers), form, context_);
  }
  template <ArrayNumber T>
  void add(std::string_view name, const std::vector<T>& numbers, const ArrayForm& form = {}) {
    add(name, std::span<const T>(numbers), form);
  }
  /// The voxels of an image, in their stored type.
  void add_voxels(std::string_view name, const CubicalImage& image);
  /// Writes the pictures for browsers that run no scripts. @param pictures SVG documents.
  void add_pictures(std::span<const std::string> pictures);
  /// Writes the rest of the page.
  void finish();

  const RunContext& context() const { return context_; }

 private:
  const Sink& sink_;
  const RunContext& context_;
};

}  // namespace ph::report
