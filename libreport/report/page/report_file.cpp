// SPDX-License-Identifier: MIT
#include "ph/detail/report/report_file.hpp"

#include <limits>

#include "ph/detail/report/page_template.hpp"

namespace ph::report {

ReportFile::ReportFile(const Sink& sink, const Metadata& metadata, const RunContext& context)
    : sink_(sink), context_(context) {
  require_built_in();
  const std::string_view page = page_template();
  sink_(page.substr(0, page.find(kPayloadMarker)));
  sink_("<script type=\"application/json\" id=\"ph-meta\">");
  sink_(metadata_json(metadata));
  sink_("</script>\n");
}

void ReportFile::add_pictures(std::span<const std::string> pictures) {
  sink_("<noscript>\n<p>Without JavaScript this page is a picture of its barcode.</p>\n");
  // The XML declaration is left out, because HTML does not have it. Texts in an SVG are escaped, so
  // no text can end the element.
  for (const std::string& svg : pictures) sink_(std::string_view(svg).substr(svg.find("<svg")));
  sink_("</noscript>\n");
}

void ReportFile::add_voxels(std::string_view name, const CubicalImage& image) {
  ArrayForm form;
  for (const Index extent : image.extents) form.shape.push_back(static_cast<std::size_t>(extent));
  with_voxels(image.type, image.voxels, [&]<class T>(const T* values) {
    form.delta = std::numeric_limits<T>::is_integer;
    RawArray array = raw_array(name, std::span(values, image.size()));
    array.is_in_file = image.is_in_file;
    write_array(sink_, array, form, context_);
  });
}

void ReportFile::finish() {
  const std::string_view page = page_template();
  sink_(page.substr(page.find(kPayloadMarker) + kPayloadMarker.size()));
}

}  // namespace ph::report
