// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ph/filtration.hpp"

namespace ph {

/// An affine map from the indices (i, j, k) of a voxel to the coordinates of its centre in space:
/// row r gives coordinate r as a[r][0] i + a[r][1] j + a[r][2] k + a[r][3]. The unit is the unit of
/// the file.
using Affine = std::array<std::array<double, 4>, 3>;

// The next structs are not nested in BarcodeInfo, which has aliases for them: Clang does not let
// std::optional make an object whose members have initialisers while the enclosing class is
// incomplete.

/// A subsample: `points` points, chosen from `of` points.
struct BarcodeSubsample {
  Index points = 0, of = 0;
  double covering_radius = 0;
};

/// The grid of voxels into which points were converted.
struct BarcodeVoxelGrid {
  double voxel = 0;           ///< edge length
  std::vector<double> first;  ///< centre of the voxel at (0, ..., 0), in the points' coordinates
  std::string value;          ///< "distance", "occupancy" or "density"
};

/// Facts about an alpha complex: its values, its space and its hidden points.
struct BarcodeAlphaValues {
  bool squared = false;  ///< values are squares of radii
  /// Length of each axis, 0 if the axis does not close up; empty if no axis does.
  std::vector<double> period;
  std::vector<Index> hidden;  ///< points that are not part of the complex
};

/// The origin of a barcode: what was computed, of what, and how. The JSON format states it in
/// addition to the bars. Empty members are left out; if `complex` is empty, the field of
/// coefficients, the dimension and the threshold are left out as well.
struct BarcodeInfo {
  std::string program;               ///< name and version
  std::string input;                 ///< path of the input
  std::string input_description;     ///< "1024 points in R^3, CSV"
  std::optional<Index> points;       ///< the number of points of the input
  std::optional<Index> coordinates;  ///< the number of coordinates of each point
  std::vector<Index> shape;          ///< extents of an image
  std::optional<Affine> affine;      ///< of an image, see ReadResult::affine
  bool nan_dropped = false;          ///< points or voxels with NaN were left out
  std::string complex;               ///< "rips", "cubical", "explicit", "lower-star", "alpha", …
  std::int64_t field = 2;
  int max_dim = 0;
  std::optional<double> threshold;
  std::optional<Index> vertices;     ///< of a Rips complex
  std::optional<std::size_t> edges;  ///< of a Rips complex, unless only points are held
  bool collapsed = false;            ///< edges were collapsed
  /// For a Rips complex, the kind of distance: "euclidean", "minkowski:3", see metric_name;
  /// "precomputed" (given by the user), "function" (a function of the user).
  std::string metric;
  /// For an image, the construction: "vertices" or "cells", see CubicalOptions::Construction.
  std::string construction;
  std::vector<int> periodic;  ///< axes of an image that close up
  /// If vertices have births, the source of the births and the weight exponent: "dtm 5, exponent
  /// 1".
  std::string vertex_weights;
  /// The subsample, if the points were chosen by a greedy permutation; see
  /// ph/greedy_permutation.hpp.
  using Subsample = BarcodeSubsample;
  std::optional<Subsample> subsample;
  /// The grid of voxels, if points were converted into an image; see ph/voxel_image.hpp.
  using VoxelGrid = BarcodeVoxelGrid;
  std::optional<VoxelGrid> voxels;
  /// Set for an alpha complex, or for another complex of the Delaunay triangulation.
  using AlphaValues = BarcodeAlphaValues;
  std::optional<AlphaValues> alpha;
  bool superlevel = false;                ///< values are the negated values of the image
  std::optional<double> approximation;    ///< epsilon of a sparse Rips filtration
  std::optional<double> min_persistence;  ///< bars of this length or less were left out
  int min_dim = 0;                        ///< bars of lower dimensions were left out
  std::vector<int> dims;  ///< if not empty, bars of all other dimensions were left out
  std::string engine;
  std::vector<std::pair<std::string, double>> timings;  ///< each stage with its seconds
  std::uint64_t peak_memory = 0;                        ///< bytes; 0 if unknown
};

}  // namespace ph
