// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ph/barcode.hpp"
#include "ph/io/write.hpp"

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

/// What decides which merges a cut does.
enum class CutRule {
  persistence,  ///< those of a persistence below the cut: MergeTree::basins
  value,        ///< those at values up to the cut: MergeTree::components
};

struct TreeMeta {
  CutRule rule = CutRule::persistence;
  std::string label, unit = {};
  double cut = 0;                    ///< where the page begins
  double from = 0;                   ///< least cut for which the contraction is right
  std::optional<double> to = {};     ///< largest one
  Index min_size = 1;                ///< fewest vertices of a segment
  std::string what;                  ///< "segment"
  std::vector<std::string> command;  ///< of another cut, "{cut}" standing for its value
};

/// Of the bars of one dimension in the two barcodes of a comparison.
struct Distance {
  int dim = 0;
  double bottleneck = 0;  ///< may be infinite
};

struct Provenance {
  std::vector<std::string> command;
  std::string sha256;        ///< of the input
  BarcodeInfo run;           ///< program, input, complex, engine, timings …
  bool has_homology = true;  ///< whether field, dimension and threshold of `run` mean something
  std::vector<std::string> warnings = {};
  std::vector<std::pair<std::string, std::string>> notes = {};  ///< what else is worth saying
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

/// What to call the data of a file: its path without folders.
std::string title_of(const std::string& path);

/// As JSON that can stand in an element of HTML: no text in it ends the element.
std::string metadata_json(const Metadata& metadata);

}  // namespace ph::report
