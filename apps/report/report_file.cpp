// SPDX-License-Identifier: MIT
#include "report_file.hpp"

#include "page_template.hpp"

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

void ReportFile::finish() {
  const std::string_view page = page_template();
  file_.write(page.substr(page.find(kPayloadMarker) + kPayloadMarker.size()));
}

}  // namespace ph::report
