// SPDX-License-Identifier: MIT
#include "barcode/complex/read_input.hpp"

#include <fmt/format.h>

#include <utility>
#include <variant>
#include <vector>

#include "core/system/files.hpp"
#include "report/encoding/sha256.hpp"

namespace ph::barcode {
namespace {

/// What a result does with a mesh that has no values, as a note; empty: it is no such mesh.
std::string note_on_mesh(const ReadResult& read, const Arguments& a) {
  const auto* const mesh = std::get_if<Mesh>(&read.data);
  if (a.complex == ComplexKind::lower_star || mesh == nullptr || mesh->faces() == 0 ||
      !mesh->values.empty())
    return {};
  return fmt::format(
      "the {} faces are not used, the vertices are points; --values FILE has values of the "
      "vertices and filters the mesh",
      mesh->faces());
}

}  // namespace

NamedData read_input(const Input& input, const Arguments& arguments, const RunContext& context) {
  std::vector<Index> dropped;
  ReadOptions options = arguments.read;
  options.context = &context;
  options.dropped = &dropped;
  ReadResult read = read_any(input, arguments.format, options, files::path_of(arguments.values));
  if (std::string note = note_on_mesh(read, arguments); !note.empty())
    read.notes.push_back(std::move(note));
  std::string sha256;
  if (!arguments.report.empty() && !arguments.dry_run) sha256 = report::sha256_hex(input, context);
  return {input.name(), std::move(read), dropped.size(), std::move(sha256)};
}

std::optional<PointsView> points_of(const ReadResult& read) {
  if (const auto* mesh = std::get_if<Mesh>(&read.data)) return mesh->vertices;
  if (const auto* points = std::get_if<Points>(&read.data)) return *points;
  return std::nullopt;
}

}  // namespace ph::barcode
