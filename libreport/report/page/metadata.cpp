// SPDX-License-Identifier: MIT
#include "ph/detail/report/metadata.hpp"

#include <fmt/format.h>

#include "ph/detail/io/barcode_formats.hpp"
#include "ph/detail/io/json_writer.hpp"

namespace ph::report {
namespace {

using json::integer, json::number, json::object;

// These functions return an empty text for an empty value, which is then left out.
std::string text(std::string_view value) { return value.empty() ? "" : json::string(value); }
std::string number_if(const std::optional<double>& value) { return value ? number(*value) : ""; }
std::string point_if(const std::optional<std::array<double, 3>>& values) {
  return values ? json::numbers(*values) : "";
}
template <class Values, class Write>
std::string list(const Values& values, Write&& write) {
  return values.empty() ? "" : json::array(values, write);
}
std::string texts(const std::vector<std::string>& values) { return list(values, json::string); }

std::string barcode(const BarcodeMeta& meta) {
  const bool has_chains = meta.representatives != Representatives::none;
  return object({{"name", text(meta.name)},
                 {"cells", text(name_of(meta.cells))},
                 {"representatives", text(has_chains ? name_of(meta.representatives) : "")}});
}

std::string cloud(const CloudMeta& meta) {
  return object({{"unit", text(meta.unit)},
                 {"viewpoint", point_if(meta.viewpoint)},
                 {"up", point_if(meta.up)},
                 {"metric", text(meta.metric)},
                 {"edges_below", number_if(meta.edges_below)},
                 {"triangles_below", number_if(meta.triangles_below)},
                 {"projection", text(meta.projection)}});
}

std::string tree(const TreeMeta& meta) {
  return object({{"rule", text(meta.rule == CutRule::persistence ? "persistence" : "value")},
                 {"label", text(meta.label)},
                 {"unit", text(meta.unit)},
                 {"cut", number(meta.cut)},
                 {"from", number(meta.from)},
                 {"to", number_if(meta.to)},
                 {"min_size", integer(meta.min_size)},
                 {"what", text(meta.what)},
                 {"command", texts(meta.command)}});
}

std::string scene(const SceneMeta& meta) {
  const auto segment = [](const SegmentMeta& s) {
    const auto number_of = [](std::uint32_t n) { return n == 0 ? "" : integer(n); };
    return object({{"number", integer(s.number)},
                   {"colour", json::string(fmt::format("#{:06x}", s.colour))},
                   {"persistence", number(s.persistence)},
                   {"role", json::string(s.role)},
                   {"on_surface", number_of(s.on_surface)},
                   {"on_segment", number_of(s.on_segment)}});
  };
  const auto surface = [](std::string_view role) { return object({{"role", json::string(role)}}); };
  return object({{"segments", json::array(meta.segments, segment)},
                 {"surfaces", json::array(meta.surface_roles, surface)},
                 {"removed", integer(meta.removed)},
                 {"flat", number(meta.flat)},
                 {"objects", meta.objects ? "true" : "false"}});
}

std::string distance(const Distance& d) {
  return object({{"dim", integer(d.dim)}, {"bottleneck", number(d.bottleneck)}});
}

std::string image(const Metadata& m) {
  return object({{"construction", text(m.construction)}, {"axes", texts(m.axes)}});
}

std::string provenance(const Provenance& p) {
  std::string timings, notes;
  for (const auto& [stage, seconds] : p.run.timings)
    json::add_members(timings, {{stage, fmt::format("{:.6g}", seconds)}});
  for (const auto& [name, note] : p.notes) json::add_members(notes, {{name, text(note)}});
  const bool has_homology = p.has_homology;
  const std::string filtration = filtration_members(p.run);
  return object({{"version", text(p.run.program)},
                 {"command", texts(p.command)},
                 {"input", object({{"path", text(p.run.input)},
                                   {"description", text(p.run.input_description)},
                                   {"sha256", text(p.sha256)}})},
                 {"complex", text(p.run.complex)},
                 {"field", has_homology ? integer(p.run.field) : ""},
                 {"max_dim", has_homology ? integer(p.run.max_dim) : ""},
                 {"threshold", !has_homology     ? ""
                               : p.run.threshold ? number(*p.run.threshold)
                                                 : "null"},
                 {"filtration", filtration.empty() ? "" : "{" + filtration + "}"},
                 {"engine", text(p.run.engine)},
                 {"timings", timings.empty() ? "" : "{" + timings + "}"},
                 {"peak_memory", p.run.peak_memory > 0 ? integer(p.run.peak_memory) : ""},
                 {"warnings", texts(p.warnings)},
                 {"notes", notes.empty() ? "" : "{" + notes + "}"}});
}

/// Escapes each "<", which occurs only in texts.
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
  return path.substr(path.rfind('/') + 1);  // this is the whole path if it has no slash
}

std::string metadata_json(const Metadata& m) {
  return without_tags(object({{"format", text("ph-report")},
                              {"version", "1"},
                              {"title", json::string(m.title)},
                              {"program", json::string(m.provenance.run.program)},
                              {"value", object({{"label", json::string(m.value_label)},
                                                {"unit", text(m.value_unit)},
                                                {"negated", m.negated ? "true" : ""}})},
                              {"barcodes", list(m.barcodes, barcode)},
                              {"cloud", m.cloud ? cloud(*m.cloud) : ""},
                              {"image", m.construction.empty() ? "" : image(m)},
                              {"tree", m.tree ? tree(*m.tree) : ""},
                              {"scene", m.scene ? scene(*m.scene) : ""},
                              {"distances", list(m.distances, distance)},
                              {"provenance", provenance(m.provenance)}}));
}

}  // namespace ph::report
