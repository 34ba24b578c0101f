// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <string>
#include <string_view>
#include <vector>

#include "libph/src/alpha/intervals/intervals.hpp"
#include "ph/alpha.hpp"
#include "ph/error.hpp"

namespace ph {
namespace alpha {
namespace {

using std::uint32_t;

void check_values(const Alpha& alpha, double value, std::string_view what) {
  if (alpha.value_kind() != AlphaOptions::Value::alpha)
    throw Error(ErrorKind::usage, fmt::format("{}: found {} values, expected alpha values", what,
                                              name_of(alpha.value_kind())));
  if (alpha.is_periodic())
    throw Error(ErrorKind::usage,
                std::string(what) + ": found a periodic space, expected one without periods");
  if (!std::isnan(value)) return;
  throw Error(ErrorKind::usage, std::string(what) + ": found nan, expected a value");
}

/// Computes the surface of a subcomplex.
/// @param has_cell, has_facet return true if a cell, or a facet given by its usual name, belongs to
/// the subcomplex.
template <class HasCell, class HasFacet>
SurfaceMesh surface(const AlphaCells& cells, HasCell&& has_cell, HasFacet&& has_facet) {
  SurfaceMesh mesh;
  std::vector<std::array<Index, 3>> singular;
  const auto triangle_of = [&](uint32_t a, uint32_t b, uint32_t c, bool is_turned) {
    const auto& input = cells.sites.input;
    if (is_turned) std::swap(b, c);  // mutant: alpha-turned
    return std::array<Index, 3>{input[a], input[b], input[c]};
  };
  const auto count = static_cast<uint32_t>(cells.triangulation.size());
  if (cells.dim() == 2)
    for (uint32_t t = 0; t < count; ++t)
      if (has_cell(t)) {
        const auto& v = cells.triangulation.cells[t];
        mesh.triangles.push_back(
            triangle_of(v[0], v[1], v[2], cells.triangulation.is_reversed[t] != 0));
      }
  if (cells.dim() == 3)
    for (uint32_t code = 0; code < 4 * count; ++code) {
      const uint32_t other = cells.across(code);
      if (other < code || !has_facet(code)) continue;  // kNone is larger than any code
      const bool here = has_cell(code >> 2), there = other != kNone && has_cell(other >> 2);
      if (here && there) continue;
      const uint32_t inside = there ? other : code;
      const bool is_turned =
          ((inside & 1) != 0) != (cells.triangulation.is_reversed[inside >> 2] != 0);
      const auto v = cells.facet_vertices(code);
      (here || there ? mesh.triangles : singular)
          .push_back(triangle_of(v[0], v[1], v[2], is_turned));
    }
  mesh.regular = mesh.triangles.size();
  mesh.triangles.insert(mesh.triangles.end(), singular.begin(), singular.end());
  return mesh;
}

/// Collects simplices step by step: the critical cells and facets that enter, their faces, all
/// simplices in the intervals of these faces, the faces of those simplices, and so on (Bauer &
/// Edelsbrunner 2017). Only cells, facets and, in dimension 3, edges are collected.
class Wrap {
 public:
  Wrap(const AlphaCells& cells, const RunContext& context)
      : cells_(cells),
        context_(context),
        has_cell_(cells.triangulation.size(), false, &context.memory),
        has_facet_(4 * cells.triangulation.size(), false, &context.memory),
        has_edge_(cells.edge_states.size(), false, &context.memory) {}

  bool has_cell(uint32_t t) const { return has_cell_[t]; }
  /// True if the facet was collected. @param code the usual name of the facet.
  bool has_facet(uint32_t code) const { return has_facet_[code]; }

  template <class Enters>
  void run(Enters&& enters) {
    Ticker ticker(context_, "wrap", cells_.triangulation.size());
    for (uint32_t t = 0; t < cells_.triangulation.size(); ++t) {
      ticker.tick();
      if (cells_.beyond[t] == 0 && enters(cells_.cell_values[t])) add_cell(t);
      follow();
    }
    for (const CriticalFacet& facet : cells_.facets) {
      if (enters(facet.value)) add_facet(facet.code);
      follow();
    }
  }

 private:
  uint32_t usual(uint32_t code) const { return std::min(code, cells_.across(code)); }

  void add_cell(uint32_t t) {
    if (has_cell_[t]) return;
    has_cell_[t] = true;
    for (uint32_t k = 0; k <= static_cast<uint32_t>(cells_.dim()); ++k)
      left_.push_back({4 * t + k, true});
  }
  // Adds a facet with the interval that it lies in.
  void add_facet(uint32_t code) {
    if (has_facet_[usual(code)]) return;
    has_facet_[usual(code)] = true;
    for (const uint32_t name : {code, cells_.across(code)})
      if (name != kNone && cells_.belongs_to(name)) add_cell(name >> 2);
    if (cells_.dim() < 3) return;
    for (const uint32_t e : cells_.facet_edges(code)) left_.push_back({e, false});
  }
  void add_edge(uint32_t e) {
    if (has_edge_[e]) return;
    has_edge_[e] = true;
    const uint32_t up = cells_.edge_states[e].up;
    if (up < kUnknown) return add_facet(up);  // mutant: alpha-wrap
    if (up != kJoins) return;
    for (const uint32_t v : cells_.edges.ends[e])
      if (cells_.vertex_up[v] == e && cells_.vertex_facet[v] != kNone)
        add_facet(cells_.vertex_facet[v]);
  }
  void follow() {
    while (!left_.empty()) {
      const Left next = left_.back();
      left_.pop_back();
      next.is_facet ? add_facet(next.name) : add_edge(next.name);
    }
  }

  struct Left {
    uint32_t name;
    bool is_facet;
  };
  const AlphaCells& cells_;
  const RunContext& context_;
  std::pmr::vector<bool> has_cell_, has_facet_, has_edge_;
  std::vector<Left> left_;  // simplices still to be added
};

}  // namespace
}  // namespace alpha

SurfaceMesh alpha_shape(const Alpha& alpha, double value) {
  alpha::check_values(alpha, value, "alpha shape");
  const alpha::AlphaCells& cells = alpha.cells();
  const auto enters = [&](double radius) { return alpha.to_value(radius) <= value; };
  return alpha::surface(
      cells, [&](std::uint32_t t) { return enters(cells.cell_values[t]); },
      [&](std::uint32_t code) { return enters(alpha::facet_value(cells, code)); });
}

SurfaceMesh wrap(const Alpha& alpha, double value, const RunContext& context) {
  alpha::check_values(alpha, value, "wrap");
  const alpha::AlphaCells& cells = alpha.cells();
  if (cells.dim() < 2) return {};
  alpha::Wrap wrap(cells, context);
  wrap.run([&](double radius) { return alpha.to_value(radius) <= value; });
  return alpha::surface(
      cells, [&](std::uint32_t t) { return wrap.has_cell(t); },
      [&](std::uint32_t code) { return wrap.has_facet(code); });
}

}  // namespace ph
