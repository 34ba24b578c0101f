// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ph/detail/report/provenance.hpp"
#include "ph/detail/report/shown_tree.hpp"

namespace ph::report {

// The metadata of a report, as docs/reference/report-format.md has them. Empty texts and lists are
// left out.

struct BarcodeMeta {
  std::string name;
  CellKind cells = CellKind::vertices;
  Representatives representatives = Representatives::none;
};

struct CloudMeta {
  std::string unit;
  std::optional<std::array<double, 3>> viewpoint = {};  ///< where the sensor stood
  std::optional<std::array<double, 3>> up = {};
  std::string metric = {};  ///< "euclidean": the page may find the edges of a Rips complex
  std::optional<double> edges_below = {};      ///< values of complex/edges that are all there
  std::optional<double> triangles_below = {};  ///< the same of complex/triangles
  std::string projection = {};                 ///< "first 3 of 10 coordinates"
};

/// Of the bars of one dimension in the two barcodes of a comparison.
struct Distance {
  int dim = 0;
  double bottleneck = 0;  ///< may be infinite
};

struct Metadata {
  std::string title;
  std::string value_label, value_unit = {};  ///< of filtration values
  bool negated = false;  ///< filtration values are minus those of the data (superlevel sets)
  std::vector<BarcodeMeta> barcodes;  ///< one, or two in a comparison
  std::optional<CloudMeta> cloud = {};
  std::string construction = {};       ///< of an image: "vertices" or "cells"
  std::vector<std::string> axes = {};  ///< of a volume in space, in the order of the array: x, y, z
  std::optional<TreeMeta> tree = {};
  std::vector<Distance> distances = {};  ///< of a comparison
  Provenance provenance;
};

/// As JSON that can stand in an element of HTML: no text in it ends the element.
std::string metadata_json(const Metadata& metadata);

}  // namespace ph::report
