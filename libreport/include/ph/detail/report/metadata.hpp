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

// The metadata of a report, as in docs/reference/report-format.md. Empty texts and lists are left
// out.

struct BarcodeMeta {
  std::string name;
  CellKind cells = CellKind::vertices;
  Representatives representatives = Representatives::none;
};

struct CloudMeta {
  std::string unit;
  std::optional<std::array<double, 3>> viewpoint = {};  ///< position of the sensor
  std::optional<std::array<double, 3>> up = {};
  std::string metric = {};  ///< "euclidean": the page may find the edges of a Rips complex itself
  std::optional<double> edges_below = {};  ///< some edges at or above this value are missing
  /// Some triangles at or above this value are missing.
  std::optional<double> triangles_below = {};
  std::string projection = {};  ///< for example "first 3 of 10 coordinates"
};

/// A segment of the segmentation that the page shows first.
struct SegmentMeta {
  std::uint32_t number = 0;  ///< the number that names the segment
  std::uint32_t colour = 0;  ///< 0x00RRGGBB
  double persistence = 0;    ///< the confidence; may be infinite
  std::string_view role;
  std::uint32_t on_surface = 0, on_segment = 0;  ///< number of the segment's support; 0: none known
};

/// The properties of a segmentation other than its labels.
struct SceneMeta {
  std::vector<SegmentMeta> segments;            ///< by label
  std::vector<std::string_view> surface_roles;  ///< role of each surface, by its number
  Index removed = 0;     ///< number of removed surfaces, on which no leaf of the tree lies
  double flat = 0;       ///< least share of vertices on its plane that a surface must have
  bool objects = false;  ///< true if the parts of an object are joined; other cuts join none
};

/// The distances between the bars of one dimension in the two barcodes of a comparison.
struct Distance {
  int dim = 0;
  double bottleneck = 0;  ///< may be infinite
};

struct Metadata {
  std::string title;
  std::string value_label, value_unit = {};  ///< label and unit of filtration values
  bool negated = false;  ///< filtration values are the negated values of the data (superlevel sets)
  std::vector<BarcodeMeta> barcodes;  ///< one barcode, or two in a comparison
  std::optional<CloudMeta> cloud = {};
  std::string construction = {};       ///< for an image: "vertices" or "cells"
  std::vector<std::string> axes = {};  ///< names of a volume's axes, in array order: x, y, z
  std::optional<TreeMeta> tree = {};
  std::optional<SceneMeta> scene = {};
  std::vector<Distance> distances = {};  ///< of a comparison
  Provenance provenance;
};

/// The metadata as JSON that can be embedded in HTML: no text in it can end the element.
std::string metadata_json(const Metadata& metadata);

}  // namespace ph::report
