// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "image/place_runs.hpp"
#include "io/barcodes/barcode_formats.hpp"

namespace ph {
namespace {

/// Length of the UTF-8 sequence at the start of `text`; 0 if it is none (overlong forms,
/// surrogates and code points beyond U+10FFFF are none).
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  if (first == 0xe0 && byte(1) < 0xa0) return 0;
  if (first == 0xed && byte(1) > 0x9f) return 0;
  if (first == 0xf0 && byte(1) < 0x90) return 0;
  if (first == 0xf4 && byte(1) > 0x8f) return 0;
  return length;
}

/// JSON knows no infinities: one that dies never is null, any other is its name as a string.
std::string json_number(double value) {
  if (std::isfinite(value)) return shortest(value);
  return value > 0 ? "null" : "\"-inf\"";
}

/// The cell without its braces: `"vertices": [0, 1]`.
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

/// null for a cell that is not known.
std::string json_cell(const std::optional<InputCell>& cell) {
  if (!cell || cell->numbers.empty()) return "null";
  return fmt::format("{{{}}}", json_cell_member(*cell));
}

std::string_view representatives_name(Representatives kind) {
  switch (kind) {
    case Representatives::none:
      return "none";
    case Representatives::cycles:
      return "cycles";
    case Representatives::cocycles:
      return "cocycles";
    case Representatives::voxels:
      return "voxels";
  }
  return "";
}

/// A chain can be as long as the input: written term by term.
void write_chain(OutputFile& file, const InputChain& chain) {
  file.write("[");
  for (std::size_t i = 0; i < chain.size(); ++i)
    file.write(fmt::format("{}{{{}, \"coefficient\": {}}}", i == 0 ? "" : ", ",
                           json_cell_member(chain.cell(i)), chain.coefficient(i)));
  file.write("]");
}

std::string_view tightness_name(Tightness tightness) {
  switch (tightness) {
    case Tightness::none:
      return "no";
    case Tightness::locally:
      return "locally";
    case Tightness::shortest:
      return "shortest";
  }
  return "";
}

/// Before anything is written.
void check_loops(const Barcode& barcode, std::span<const BarLoops> loops) {
  if (loops.empty()) return;
  const auto fail = [](const std::string& found, const std::string& expected) {
    throw Error(ErrorKind::usage, fmt::format("loops: found {}, expected {}", found, expected));
  };
  if (loops.size() != barcode.size())
    fail(fmt::format("those of {} bars", loops.size()), fmt::format("{}, or none", barcode.size()));
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (loops[i].loops.empty()) continue;
    const std::string bar = fmt::format("bar {} ", i);
    if (barcode.representatives() == Representatives::none || barcode.representative(i).size() == 0)
      fail(bar + "without a chain", "loops beside a cycle");
    const InputCell edge = barcode.representative(i).cell(0);
    if (edge.kind == CellKind::row) fail(bar + "of rows of a matrix", "cells with vertices");
    const std::size_t arity = edge.kind == CellKind::grid ? edge.numbers.size() : 1;
    for (const Loop& loop : loops[i].loops)
      if (loop.numbers.empty() || loop.numbers.size() % arity != 0)
        fail(bar + fmt::format("with a loop of {} numbers", loop.numbers.size()),
             fmt::format("{} a vertex", arity));
  }
}

/// A member of a bar. @param edge of its chain.
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
    if (loop.length) file.write(fmt::format(", \"length\": {}", json_number(*loop.length)));
    file.write(fmt::format(", \"tight\": \"{}\"}}", tightness_name(of_bar.tightness)));
    between = ", ";
  }
  file.write("]");
}

/// The voxels of a bar, and a cycle where there are none.
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
  for_each_run(barcode.voxels(i), [&](std::uint64_t first, std::uint64_t count) {
    file.write(fmt::format("{}[{}, {}]", between, first, count));
    between = ", ";
  });
  file.write("]");
}

std::string json_timings(const BarcodeInfo& info) {
  std::string text;
  for (const auto& [stage, seconds] : info.timings) {
    if (!text.empty()) text += ", ";
    text += fmt::format("{}: {:.6g}", json_string(stage), seconds);
  }
  return "{" + text + "}";
}

}  // namespace

std::string json_string(std::string_view text) {
  std::string out = "\"";
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const char c = text.front();
    if (length == 0) {
      out += "\xef\xbf\xbd";  // U+FFFD
    } else if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out + "\"";
}

void write_barcode_json(OutputFile& file, const Barcode& barcode, const BarcodeInfo& info) {
  check_loops(barcode, info.loops);
  file.write("{\n  \"format\": \"ph-barcode\",\n  \"version\": 1,\n");
  file.write(fmt::format("  \"program\": {},\n", json_string(info.program)));
  file.write(fmt::format("  \"input\": {{\"path\": {}, \"description\": {}}},\n",
                         json_string(info.input), json_string(info.input_description)));
  if (!info.complex.empty())
    file.write(fmt::format(
        "  \"complex\": {},\n  \"field\": {},\n  \"max_dim\": {},\n  \"threshold\": {},\n",
        json_string(info.complex), info.field, info.max_dim,
        info.threshold ? json_number(*info.threshold) : "null"));
  if (!info.vertex_weights.empty())
    file.write(fmt::format("  \"vertex_weights\": {},\n", json_string(info.vertex_weights)));
  if (info.subsample)
    file.write(fmt::format(
        "  \"subsample\": {{\"points\": {}, \"of\": {}, \"covering_radius\": {}}},\n",
        info.subsample->points, info.subsample->of, json_number(info.subsample->covering_radius)));
  if (info.voxels) {
    std::string first;
    for (const double x : info.voxels->first) first += (first.empty() ? "" : ", ") + json_number(x);
    file.write(fmt::format("  \"voxels\": {{\"edge\": {}, \"first\": [{}], \"value\": {}}},\n",
                           json_number(info.voxels->voxel), first,
                           json_string(info.voxels->value)));
  }
  if (info.superlevel) file.write("  \"superlevel\": true,\n");
  if (info.approximation)
    file.write(fmt::format("  \"approximation\": {},\n", json_number(*info.approximation)));
  const bool with_chains = barcode.representatives() != Representatives::none;
  if (!info.engine.empty())
    file.write(fmt::format("  \"engine\": {},\n", json_string(info.engine)));
  if (with_chains)
    file.write(fmt::format("  \"representatives\": \"{}\",\n",
                           representatives_name(barcode.representatives())));
  file.write("  \"bars\": [");
  for (std::size_t i = 0; i < barcode.size(); ++i) {
    const Bar& bar = barcode[i];
    file.write(i == 0 ? "\n" : ",\n");
    file.write(fmt::format("    {{\"dim\": {}, \"birth\": {}, \"death\": {}, ", bar.dim,
                           json_number(bar.birth), json_number(bar.death)));
    file.write(fmt::format("\"birth_cell\": {}, \"death_cell\": {}",
                           json_cell(barcode.birth_cell(i)), json_cell(barcode.death_cell(i))));
    if (barcode.representatives() == Representatives::voxels) {
      write_voxels(file, barcode, i);
    } else if (with_chains) {
      file.write(", \"representative\": ");
      write_chain(file, barcode.representative(i));
    }
    if (!info.loops.empty() && !info.loops[i].loops.empty())
      write_loops(file, info.loops[i], barcode.representative(i).cell(0));
    file.write("}");
  }
  file.write(barcode.empty() ? "],\n" : "\n  ],\n");
  file.write(fmt::format("  \"timings\": {},\n", json_timings(info)));
  file.write(info.peak_memory == 0 ? "  \"peak_memory\": null\n}\n"
                                   : fmt::format("  \"peak_memory\": {}\n}}\n", info.peak_memory));
}

}  // namespace ph
