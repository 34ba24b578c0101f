// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
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

/// A segment of the segmentation that a page shows first.
struct SegmentMeta {
  std::uint32_t number = 0;  ///< what it is called
  std::uint32_t colour = 0;  ///< 0x00RRGGBB
  double persistence = 0;    ///< the confidence; may be infinite
  std::string_view role;
  std::uint32_t on_surface = 0, on_segment = 0;  ///< what it stands on, by number; 0: not that
};

/// What a segmentation says besides the labels.
struct SceneMeta {
  std::vector<SegmentMeta> segments;            ///< by label
  std::vector<std::string_view> surface_roles;  ///< of the surfaces, by number
  Index removed = 0;     ///< how many of these were removed: no leaf of the tree is on them
  double flat = 0;       ///< least share on the plane of a surface of what is one
  double min_seam = 0;   ///< what other cuts leave out: weak seams are joined
  bool objects = false;  ///< and parts of an object are
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
  std::optional<SceneMeta> scene = {};
  std::vector<Distance> distances = {};  ///< of a comparison
  Provenance provenance;
};

/// As JSON that can stand in an element of HTML: no text in it ends the element.
std::string metadata_json(const Metadata& metadata);

}  // namespace ph::report
