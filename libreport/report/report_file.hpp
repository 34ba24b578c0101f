// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ph/detail/image/cubical_image.hpp"
#include "ph/run_context.hpp"
#include "report/encoding/array_block.hpp"
#include "report/metadata.hpp"

namespace ph::report {

/// A report while it is written: the page up to the marker, the metadata, arrays in any order, the
/// rest of the page. docs/reference/report-format.md says what each array is.
/// All functions throw Error (cancelled) and what the sink throws.
class ReportFile {
 public:
  /// @throws Error (not_built_in) without a page.
  ReportFile(const Sink& sink, const Metadata& metadata, const RunContext& context);
  template <ArrayNumber T>
  void add(std::string_view name, std::span<const T> numbers, const ArrayForm& form = {}) {
    write_array(sink_, raw_array(name, numbers), form, context_);
  }
  template <ArrayNumber T>
  void add(std::string_view name, const std::vector<T>& numbers, const ArrayForm& form = {}) {
    add(name, std::span<const T>(numbers), form);
  }
  /// The voxels of an image, as they are stored.
  void add_voxels(std::string_view name, const CubicalImage& image);
  /// Writes what is seen where scripts do not run. @param pictures SVG documents.
  void add_pictures(std::span<const std::string> pictures);
  /// Writes the rest of the page.
  void finish();

  const RunContext& context() const { return context_; }

 private:
  const Sink& sink_;
  const RunContext& context_;
};

}  // namespace ph::report
