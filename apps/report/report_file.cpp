// SPDX-License-Identifier: MIT
#include "report/report_file.hpp"

#include <limits>

#include "report/page_template.hpp"

namespace ph::report {

ReportFile::ReportFile(OutputFile& file, const Metadata& metadata, const RunContext& context)
    : file_(file), context_(context) {
  require_built_in("--report");
  const std::string_view page = page_template();
  file_.write(page.substr(0, page.find(kPayloadMarker)));
  file_.write("<script type=\"application/json\" id=\"ph-meta\">");
  file_.write(metadata_json(metadata));
  file_.write("</script>\n");
}

void ReportFile::add_pictures(std::span<const std::string> pictures) {
  file_.write("<noscript>\n<p>Without JavaScript this page is a picture of its barcode.</p>\n");
  // HTML has no XML declaration. Texts in an SVG are escaped: none ends the element.
  for (const std::string& svg : pictures)
    file_.write(std::string_view(svg).substr(svg.find("<svg")));
  file_.write("</noscript>\n");
}

void ReportFile::add_voxels(std::string_view name, const CubicalImage& image) {
  ArrayForm form;
  for (const Index extent : image.extents) form.shape.push_back(static_cast<std::size_t>(extent));
  with_voxels(image.type, image.voxels, [&]<class T>(const T* values) {
    form.delta = std::numeric_limits<T>::is_integer;
    RawArray array = raw_array(name, std::span(values, image.size()));
    array.is_in_file = image.is_in_file;
    write_array(file_, array, form, context_);
  });
}

void ReportFile::finish() {
  const std::string_view page = page_template();
  file_.write(page.substr(page.find(kPayloadMarker) + kPayloadMarker.size()));
}

}  // namespace ph::report
