// SPDX-License-Identifier: MIT
#include "report/metadata.hpp"

#include <fmt/format.h>

#include "report/encoding/json_object.hpp"

namespace ph::report {
namespace {

std::string texts(const std::vector<std::string>& values) {
  return json_array(values, [](const std::string& value) { return json_string(value); });
}

std::string numbers(const std::optional<std::array<double, 3>>& values) {
  return values ? json_array(*values, json_number) : std::string();
}

std::string barcode(const BarcodeMeta& meta) {
  constexpr std::string_view kinds[] = {"vertices", "grid", "row"};
  constexpr std::string_view chains[] = {"", "cycles", "cocycles", "voxels"};
  return JsonObject()
      .text("name", meta.name)
      .text("cells", kinds[static_cast<int>(meta.cells)])
      .text("representatives", chains[static_cast<int>(meta.representatives)])
      .str();
}

std::string cloud(const CloudMeta& meta) {
  return JsonObject()
      .text("unit", meta.unit)
      .add("viewpoint", numbers(meta.viewpoint))
      .add("up", numbers(meta.up))
      .text("metric", meta.metric)
      .add("edges_below", meta.edges_below ? json_number(*meta.edges_below) : "")
      .add("triangles_below", meta.triangles_below ? json_number(*meta.triangles_below) : "")
      .text("projection", meta.projection)
      .str();
}

std::string tree(const TreeMeta& meta) {
  return JsonObject()
      .text("rule", meta.rule == CutRule::persistence ? "persistence" : "value")
      .text("label", meta.label)
      .text("unit", meta.unit)
      .add("cut", json_number(meta.cut))
      .add("from", json_number(meta.from))
      .add("to", meta.to ? json_number(*meta.to) : "")
      .add("min_size", fmt::format("{}", meta.min_size))
      .text("what", meta.what)
      .add("command", texts(meta.command))
      .str();
}

std::string distance(const Distance& d) {
  return JsonObject()
      .add("dim", fmt::format("{}", d.dim))
      .add("bottleneck", json_number(d.bottleneck))
      .str();
}

std::string provenance(const Provenance& p) {
  JsonObject timings, notes;
  for (const auto& [stage, seconds] : p.run.timings)
    timings.add(stage, fmt::format("{:.6g}", seconds));
  for (const auto& [name, text] : p.notes) notes.text(name, text);
  JsonObject object;
  object.text("version", p.run.program)
      .add("command", texts(p.command))
      .add("input", JsonObject()
                        .text("path", p.run.input)
                        .text("description", p.run.input_description)
                        .text("sha256", p.sha256)
                        .str())
      .text("complex", p.run.complex);
  if (p.has_homology) {
    object.add("field", fmt::format("{}", p.run.field))
        .add("max_dim", fmt::format("{}", p.run.max_dim))
        .add("threshold", p.run.threshold ? json_number(*p.run.threshold) : "null");
  }
  object.text("engine", p.run.engine);
  if (!timings.empty()) object.add("timings", timings.str());
  if (p.run.peak_memory > 0) object.add("peak_memory", fmt::format("{}", p.run.peak_memory));
  object.add("warnings", texts(p.warnings));
  if (!notes.empty()) object.add("notes", notes.str());
  return object.str();
}

/// "<" is in texts only.
std::string without_tags(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

}  // namespace

std::string title_of(const std::string& path) {
  return path.substr(path.rfind('/') + 1);  // all of it if there is none
}

std::string metadata_json(const Metadata& m) {
  JsonObject object;
  object.text("format", "ph-report")
      .add("version", "1")
      .add("title", json_string(m.title))
      .add("program", json_string(m.provenance.run.program))
      .add("value", JsonObject()
                        .add("label", json_string(m.value_label))
                        .text("unit", m.value_unit)
                        .add("negated", m.negated ? "true" : "")
                        .str())
      .add("barcodes", json_array(m.barcodes, barcode));
  if (m.cloud) object.add("cloud", cloud(*m.cloud));
  if (!m.construction.empty())
    object.add("image",
               JsonObject().text("construction", m.construction).add("axes", texts(m.axes)).str());
  if (m.tree) object.add("tree", tree(*m.tree));
  object.add("distances", json_array(m.distances, distance));
  object.add("provenance", provenance(m.provenance));
  return without_tags(object.str());
}

}  // namespace ph::report
