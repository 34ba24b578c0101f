// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "ph/detail/image/voxel_runs.hpp"
#include "ph/detail/io/barcode_formats.hpp"
#include "ph/detail/io/json_writer.hpp"

namespace ph {
namespace {

/// JSON has no infinities. Minus infinity therefore becomes the string "-inf", and plus infinity
/// becomes null. A death of null means that the class never dies.
std::string json_value(double value) {
  return value == -kInfinity ? "\"-inf\"" : json::number(value);
}

/// A cell as a member, without the braces of an object: `"vertices": [0, 1]`.
std::string json_cell_member(const InputCell& cell) {
  switch (cell.kind) {
    case CellKind::vertices:
      return fmt::format("\"vertices\": [{}]", fmt::join(cell.numbers, ", "));
    case CellKind::grid:
      return fmt::format("\"grid\": [{}]", fmt::join(cell.numbers, ", "));
    case CellKind::row:
      return fmt::format("\"row\": {}", fmt::join(cell.numbers, ", "));
  }
  return "";
}

/// A cell as an object, or null if the cell is unknown.
std::string json_cell(const std::optional<InputCell>& cell) {
  if (!cell || cell->numbers.empty()) return "null";
  return fmt::format("{{{}}}", json_cell_member(*cell));
}

/// Writes a chain term by term, because a chain can be as long as the input.
void write_chain(OutputFile& file, const InputChain& chain) {
  file.write("[");
  for (std::size_t i = 0; i < chain.size(); ++i)
    file.write(fmt::format("{}{{{}, \"coefficient\": {}}}", i == 0 ? "" : ", ",
                           json_cell_member(chain.cell(i)), chain.coefficient(i)));
  file.write("]");
}

/// Throws if the loops do not match the bars. Called before anything is written.
void check_loops(const Barcode& barcode, std::span<const BarLoops> loops) {
  if (loops.empty()) return;
  const auto fail = [](const std::string& found, const std::string& expected) {
    throw Error(ErrorKind::usage, fmt::format("loops: found {}, expected {}", found, expected));
  };
  if (loops.size() != barcode.size())
    fail(fmt::format("loops of {} bars", loops.size()), fmt::format("{}, or none", barcode.size()));
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (loops[i].loops.empty()) continue;
    const std::string bar = fmt::format("bar {} ", i);
    if (barcode.representatives() == Representatives::none || barcode.representative(i).size() == 0)
      fail(bar + "without a chain", "loops only for bars with a cycle");
    const InputCell edge = barcode.representative(i).cell(0);
    if (edge.kind == CellKind::row)
      fail(bar + "whose cells are rows of a matrix", "cells with vertices");
    const std::size_t arity = edge.kind == CellKind::grid ? edge.numbers.size() : 1;
    for (const Loop& loop : loops[i].loops)
      if (loop.numbers.empty() || loop.numbers.size() % arity != 0)
        fail(bar + fmt::format("with a loop of {} numbers", loop.numbers.size()),
             fmt::format("{} per vertex", arity));
  }
}

/// Writes the member "loops" of a bar. @param edge any cell of the bar's chain. It determines
/// whether vertices are written as numbers or as grid coordinates.
void write_loops(OutputFile& file, const BarLoops& of_bar, const InputCell& edge) {
  const bool is_grid = edge.kind == CellKind::grid;
  const std::size_t arity = is_grid ? edge.numbers.size() : 1;
  std::string_view between = ", \"loops\": [";
  for (const Loop& loop : of_bar.loops) {
    const std::span<const Index> numbers = loop.numbers;
    file.write(fmt::format("{}{{\"{}\": [", between, is_grid ? "grid" : "vertices"));
    for (std::size_t i = 0; i < numbers.size(); i += arity) {
      const std::string text = fmt::format("{}", fmt::join(numbers.subspan(i, arity), ", "));
      file.write(i == 0 ? "" : ", ");
      file.write(is_grid ? "[" + text + "]" : text);
    }
    file.write(fmt::format("], \"coefficient\": {}", loop.coefficient));
    if (loop.length) file.write(fmt::format(", \"length\": {}", json_value(*loop.length)));
    file.write(fmt::format(", \"tight\": \"{}\"}}", name_of(of_bar.tightness)));
    between = ", ";
  }
  file.write("]");
}

/// Writes the birth voxel and the death voxel of a bar, then its cycle. If the bar has no cycle,
/// writes its set of voxels instead.
void write_voxels(OutputFile& file, const Barcode& barcode, std::size_t i) {
  file.write(fmt::format(", \"birth_voxel\": [{}]", fmt::join(barcode.birth_voxel(i), ", ")));
  const auto death = barcode.death_voxel(i);
  file.write(death.empty() ? ", \"death_voxel\": null"
                           : fmt::format(", \"death_voxel\": [{}]", fmt::join(death, ", ")));
  const InputChain cycle = barcode.representative(i);
  if (cycle.size() > 0) {
    file.write(", \"representative\": ");
    return write_chain(file, cycle);
  }
  file.write(", \"voxels\": [");
  std::string_view between;
  for_each_voxel_run(barcode.voxels(i), [&](std::uint64_t first, std::uint64_t count) {
    file.write(fmt::format("{}[{}, {}]", between, first, count));
    between = ", ";
  });
  file.write("]");
}

std::string json_timings(const BarcodeInfo& info) {
  std::string text;
  for (const auto& [stage, seconds] : info.timings)
    json::add_members(text, {{stage, fmt::format("{:.6g}", seconds)}});
  return "{" + text + "}";
}

}  // namespace

std::string filtration_members(const BarcodeInfo& info, std::string_view between) {
  std::string subsample, voxels, alpha;
  if (info.subsample)
    subsample = json::object({{"points", json::integer(info.subsample->points)},
                              {"of", json::integer(info.subsample->of)},
                              {"covering_radius", json_value(info.subsample->covering_radius)}});
  if (info.voxels)
    voxels = json::object({{"edge", json_value(info.voxels->voxel)},
                           {"first", json::array(info.voxels->first, json_value)},
                           {"value", json::string(info.voxels->value)}});
  if (info.alpha) {
    const auto& [squared, period, hidden] = *info.alpha;
    alpha =
        json::object({{"squared", squared ? "true" : "false"},
                      {"period", period.empty() ? "" : json::array(period, json_value)},
                      {"hidden", hidden.empty() ? "" : json::array(hidden, json::integer<Index>)}});
  }
  std::string members;
  json::add_members(
      members,
      {{"metric", info.metric.empty() ? "" : json::string(info.metric)},
       {"construction", info.construction.empty() ? "" : json::string(info.construction)},
       {"periodic", info.periodic.empty() ? "" : json::array(info.periodic, json::integer<int>)},
       {"vertex_weights", info.vertex_weights.empty() ? "" : json::string(info.vertex_weights)},
       {"subsample", subsample},
       {"voxels", voxels},
       {"alpha", alpha},
       {"superlevel", info.superlevel ? "true" : ""},
       {"approximation", info.approximation ? json_value(*info.approximation) : ""},
       {"min_persistence", info.min_persistence ? json_value(*info.min_persistence) : ""},
       {"min_dim", info.min_dim > 0 ? json::integer(info.min_dim) : ""},
       {"dims", info.dims.empty() ? "" : json::array(info.dims, json::integer<int>)}},
      between);
  return members;
}

namespace {

std::string json_input(const BarcodeInfo& info) {
  const auto row = [](const auto& numbers) { return json::array(numbers, json_value); };
  return json::object(
      {{"path", json::string(info.input)},
       {"description", json::string(info.input_description)},
       {"points", info.points ? json::integer(*info.points) : ""},
       {"coordinates", info.coordinates ? json::integer(*info.coordinates) : ""},
       {"shape", info.shape.empty() ? "" : json::array(info.shape, json::integer<Index>)},
       {"affine", info.affine ? json::array(*info.affine, row) : ""},
       {"nan", info.nan_dropped ? json::string("drop") : ""}});
}

/// The members that come before the bars in the file.
std::string json_heading(const Barcode& barcode, const BarcodeInfo& info) {
  // add_members leaves out a member without a value.
  const auto text = [](std::string_view value) { return value.empty() ? "" : json::string(value); };
  const bool has_complex = !info.complex.empty();
  const bool has_chains = barcode.representatives() != Representatives::none;
  constexpr std::string_view kBetween = ",\n  ";
  std::string heading;
  json::add_members(heading,
                    {{"format", json::string("ph-barcode")},
                     {"version", "1"},
                     {"program", json::string(info.program)},
                     {"input", json_input(info)},
                     {"complex", text(info.complex)},
                     {"field", has_complex ? json::integer(info.field) : ""},
                     {"max_dim", has_complex ? json::integer(info.max_dim) : ""},
                     {"threshold", !has_complex     ? ""
                                   : info.threshold ? json_value(*info.threshold)
                                                    : "null"},
                     {"vertices", info.vertices ? json::integer(*info.vertices) : ""},
                     {"edges", info.edges ? json::integer(*info.edges) : ""},
                     {"collapsed", info.collapsed ? "true" : ""}},
                    kBetween);
  if (const std::string members = filtration_members(info, kBetween); !members.empty())
    heading.append(kBetween) += members;
  json::add_members(
      heading,
      {{"engine", text(info.engine)},
       {"representatives", has_chains ? json::string(name_of(barcode.representatives())) : ""}},
      kBetween);
  return heading;
}

}  // namespace

void write_barcode_json(OutputFile& file, const Barcode& barcode, const BarcodeInfo& info,
                        const BarData& data) {
  check_loops(barcode, data.loops);
  const bool with_chains = barcode.representatives() != Representatives::none;
  file.write(fmt::format("{{\n  {},\n  \"bars\": [", json_heading(barcode, info)));
  for (std::size_t i = 0; i < barcode.size(); ++i) {
    const Bar& bar = barcode[i];
    file.write(i == 0 ? "\n" : ",\n");
    file.write(fmt::format("    {{\"dim\": {}, \"birth\": {}, \"death\": {}, ", bar.dim,
                           json_value(bar.birth), json_value(bar.death)));
    file.write(fmt::format("\"birth_cell\": {}, \"death_cell\": {}",
                           json_cell(barcode.birth_cell(i)), json_cell(barcode.death_cell(i))));
    if (!data.p_values.empty() && !std::isnan(data.p_values[i]))
      file.write(fmt::format(", \"p\": {}", json::number(data.p_values[i])));
    if (barcode.representatives() == Representatives::voxels) {
      write_voxels(file, barcode, i);
    } else if (with_chains) {
      file.write(", \"representative\": ");
      write_chain(file, barcode.representative(i));
    }
    if (!data.loops.empty() && !data.loops[i].loops.empty())
      write_loops(file, data.loops[i], barcode.representative(i).cell(0));
    file.write("}");
  }
  file.write(barcode.empty() ? "],\n" : "\n  ],\n");
  file.write(fmt::format("  \"timings\": {},\n  \"peak_memory\": {}\n}}\n", json_timings(info),
                         info.peak_memory == 0 ? "null" : json::integer(info.peak_memory)));
}

}  // namespace ph
