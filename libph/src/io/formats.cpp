// SPDX-License-Identifier: MIT
#include "ph/io/read.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/cloud.hpp"

namespace ph {
namespace {

ReadResult result_of(Points points, std::string_view kind) {
  ReadResult result;
  result.description = fmt::format("{} point{} in R^{}, {}", points.rows(),
                                   points.rows() == 1 ? "" : "s", points.cols(), kind);
  result.data = std::move(points);
  return result;
}

ReadResult result_of(DistanceMatrix distances, std::string_view kind) {
  ReadResult result;
  result.description = fmt::format("distances of {} points, {}", distances.size(), kind);
  result.data = std::move(distances);
  return result;
}

ReadResult result_of(Image image, std::string_view kind) {
  ReadResult result;
  result.description =
      image.dim() == 1
          ? fmt::format("signal of {} values, {}", image.extents[0], kind)
          : fmt::format("image of {} voxels, {}", fmt::join(image.extents, " x "), kind);
  result.data = std::move(image);
  return result;
}

ReadResult result_of(Mesh mesh, std::string_view kind) {
  ReadResult result;
  result.description =
      fmt::format("mesh of {} vertices and {} faces, {}", mesh.vertices.rows(), mesh.faces(), kind);
  result.data = std::move(mesh);
  return result;
}

ReadResult result_of(SparseDistances sparse, std::string_view kind) {
  ReadResult result;
  result.description =
      fmt::format("{} distances of {} points, {}", sparse.edges().size(), sparse.size(), kind);
  result.data = std::move(sparse);
  return result;
}

ReadResult result_of(BoundaryInput boundary, std::string_view kind) {
  ReadResult result;
  result.description = fmt::format("boundary matrix of {} cells, {}", boundary.matrix.size(), kind);
  result.data = std::move(boundary);
  return result;
}

ReadResult points_result(const Input& input, const ReadOptions& options) {
  const std::string_view first = input.text().substr(0, 4096);
  const char* kind = first.find(',') != std::string_view::npos ? "CSV" : "text";
  return result_of(read_points(input, options), kind);
}
ReadResult distance_result(const Input& input, const ReadOptions& options) {
  return result_of(read_distances(input, options), "square matrix");
}
ReadResult lower_result(const Input& input, const ReadOptions& options) {
  return result_of(read_lower_distances(input, options), "lower triangle");
}
ReadResult upper_result(const Input& input, const ReadOptions& options) {
  return result_of(read_upper_distances(input, options), "upper triangle");
}
ReadResult binary_result(const Input& input, const ReadOptions& options) {
  return result_of(read_binary_distances(input, options), "binary lower triangle");
}
ReadResult sparse_result(const Input& input, const ReadOptions& options) {
  return result_of(read_sparse(input, options), "sparse");
}
ReadResult dipha_result(const Input& input, const ReadOptions& options) {
  switch (detail::dipha_type(input)) {
    case detail::DiphaType::boundary_matrix:
      return result_of(detail::read_dipha_boundary(input, options), "DIPHA");
    case detail::DiphaType::image:
      return result_of(detail::read_dipha_image(input, options), "DIPHA");
    case detail::DiphaType::distance_matrix:
      return result_of(detail::read_dipha_distances(input, options), "DIPHA");
    case detail::DiphaType::sparse_distance_matrix:
      return result_of(detail::read_dipha_sparse(input, options), "DIPHA");
    case detail::DiphaType::diagram:
      break;
  }
  input.fail({"a persistence diagram", "DIPHA file type 2",
              "an image, a distance matrix or a boundary matrix", "it is a result, not an input"});
}
ReadResult pgm_result(const Input& input, const ReadOptions&) {
  return result_of(detail::read_pgm_image(input), "PGM");
}
ReadResult nifti_result(const Input& input, const ReadOptions& options) {
  ReadResult result = result_of(read_nifti(input, options), "NIfTI-1");
  result.affine = detail::nifti_affine(input);
  return result;
}
ReadResult result_of(detail::Volume volume, std::string_view kind) {
  ReadResult result = result_of(std::move(volume.image), kind);
  result.affine = volume.affine;
  return result;
}
ReadResult nrrd_result(const Input& input, const ReadOptions& options) {
  return result_of(detail::read_nrrd(input, options), "NRRD");
}
ReadResult meta_image_result(const Input& input, const ReadOptions& options) {
  return result_of(detail::read_meta_image(input, options), "MetaImage");
}
ReadResult vti_result(const Input& input, const ReadOptions& options) {
  return result_of(detail::read_vti(input, options), "VTI");
}
ReadResult raw_result(const Input& input, const ReadOptions& options) {
  if (!options.raw)
    throw Error(ErrorKind::usage,
                "format raw: found no layout, expected the layout of an image or of points");
  if (options.raw->coordinates != 0)
    return result_of(read_raw_points(input, *options.raw, options), "raw");
  return result_of(read_raw(input, *options.raw, options), "raw");
}
ReadResult perseus_result(const Input& input, const ReadOptions& options) {
  PerseusImage perseus = read_perseus(input, options);
  ReadResult result = result_of(std::move(perseus.image), "Perseus");
  if (std::count(perseus.periodic.begin(), perseus.periodic.end(), true) > 0) {
    result.description += ", periodic";
    result.periodic = std::move(perseus.periodic);
  }
  detail::note(options,
               "Perseus and GUDHI read the values as values of the top-dimensional cubes, as " +
                   mark(Setting::construction, "cells") + " does");
  return result;
}
ReadResult cloud_of(const Cloud& cloud, const Input& input, const ReadOptions& options,
                    std::string_view kind) {
  return result_of(detail::without_nan_rows(points_of(cloud), input, options, true), kind);
}
ReadResult xyz_result(const Input& input, const ReadOptions& options) {
  const ReadOptions inner{.allow_empty = true, .context = options.context, .note = options.note};
  return cloud_of(read_xyz(input, inner), input, options, "XYZ");
}
ReadResult pts_result(const Input& input, const ReadOptions& options) {
  const ReadOptions inner{.allow_empty = true, .context = options.context};
  return cloud_of(read_pts(input, inner), input, options, "PTS");
}
ReadResult grid_result(const Input& input, const ReadOptions& options) {
  return result_of(detail::read_grid(input, options), "text");
}
ReadResult npy_result(const Input& input, const ReadOptions& options) {
  const detail::ArrayGuess guess = detail::guess_array(input, options);
  if (!guess.note.empty()) detail::note(options, guess.note);
  if (guess.meaning == ArrayMeaning::image) detail::refuse_columns(options, "an image");
  if (guess.meaning == ArrayMeaning::distances) detail::refuse_columns(options, "distances, NPY");
  switch (guess.meaning) {
    case ArrayMeaning::points:
      return result_of(read_points(input, options), "NPY");
    case ArrayMeaning::distances:
      return result_of(read_distances(input, options), "NPY");
    default:
      break;
  }
  return result_of(read_npy_image(input, options), "NPY");
}
ReadResult npz_result(const Input& input, const ReadOptions& options) {
  const Input array = detail::read_npz_member(input);
  ReadResult result = npy_result(array, options);
  detail::note(options, "read as " + array.name());
  return result;
}
ReadResult png_result(const Input& input, const ReadOptions& options) {
  return result_of(detail::read_png_image(input, options), "PNG");
}
ReadResult tiff_result(const Input& input, const ReadOptions& options) {
  return result_of(detail::read_tiff_image(input, options), "TIFF");
}
ReadResult phat_result(const Input& input, const ReadOptions& options) {
  BoundaryInput boundary = read_phat(input, options);
  const char* kind = boundary.binary ? "PHAT binary" : "PHAT ascii";
  return result_of(std::move(boundary), kind);
}
ReadResult simplices_result(const Input& input, const ReadOptions& options) {
  SimplicesInput simplices = read_simplices(input, options);
  ReadResult result;
  result.description = fmt::format("{} simplices", simplices.simplices.size());
  result.data = std::move(simplices);
  return result;
}
ReadResult off_result(const Input& input, const ReadOptions& options) {
  return result_of(read_off(input, options), "OFF");
}
ReadResult ply_result(const Input& input, const ReadOptions& options) {
  Mesh mesh = read_ply_mesh(input, options);
  if (mesh.faces() > 0) return result_of(std::move(mesh), "PLY");
  return result_of(detail::without_nan_rows(std::move(mesh.vertices), input, options, true), "PLY");
}
ReadResult pcd_result(const Input& input, const ReadOptions& options) {
  if (!detail::is_pcd(input)) {
    const std::string_view first = input.text().substr(0, input.text().find('\n'));
    input.fail({"not a PCD file", printable(first, 40), "a header with VERSION and FIELDS", {}});
  }
  return result_of(read_points(input, options), "PCD");
}

constexpr std::array kFormats{
    FormatInfo{Format::automatic, "auto", "by content and extension", "", nullptr},
    FormatInfo{Format::points, "points",
               "one point per line, numbers separated by blanks or commas", "0.5 1.25 -3e-2",
               &points_result},
    FormatInfo{Format::distance, "distance", "a square distance matrix, one row per line",
               "0 1.5 2", &distance_result},
    FormatInfo{Format::lower_distance, "lower-distance",
               "its lower triangle without the diagonal: 1, 2, 3, … numbers per line", "1.5 2",
               &lower_result},
    FormatInfo{Format::upper_distance, "upper-distance",
               "its upper triangle without the diagonal: n-1, …, 2, 1 numbers per line", "1.5 2",
               &upper_result},
    FormatInfo{Format::sparse, "sparse", "pairs of points with their distance: i j d, from 0",
               "0 1 1.5", &sparse_result},
    FormatInfo{Format::binary, "binary", "the lower triangle as float32, little endian", "",
               &binary_result},
    FormatInfo{Format::dipha, "dipha", "DIPHA: an image, distances or a weighted boundary matrix",
               "", &dipha_result},
    FormatInfo{Format::npy, "npy", "a NumPy array: an image, points or distances", "", &npy_result},
    FormatInfo{Format::pgm, "pgm", "a grey picture, P2 or P5, 8 or 16 bits", "P2 640 480 255",
               &pgm_result},
    FormatInfo{Format::png, "png",
               "a picture: grey, or one \x1e"
               "channel\x1f of it",
               "", &png_result},
    FormatInfo{Format::tiff, "tiff",
               "a picture, or a volume of one page per slice: grey, or one \x1e"
               "channel\x1f of it",
               "", &tiff_result},
    FormatInfo{Format::perseus, "perseus",
               "a cubical complex as text: dimension, sizes, values; or one cube per line", "2",
               &perseus_result},
    FormatInfo{Format::nifti, "nifti", "a NIfTI-1 volume in one file", "", &nifti_result},
    FormatInfo{Format::nrrd, "nrrd", "an NRRD volume, in one file or two", "NRRD0004",
               &nrrd_result},
    FormatInfo{Format::metaimage, "metaimage", "a MetaImage volume, in one file or two",
               "ObjectType = Image", &meta_image_result},
    FormatInfo{Format::vti, "vti", "an array of a VTK image: FILE.vti or FILE.vti:NAME",
               "<VTKFile type=\"ImageData\" …>", &vti_result},
    FormatInfo{Format::phat, "phat",
               "a boundary matrix, ascii or binary: one cell per line, "
               "its dimension and facets",
               "1 0 1", &phat_result},
    FormatInfo{Format::simplices, "simplices",
               "one simplex with its value per line: v0 v1 … : value", "0 1 2 : 0.5",
               &simplices_result},
    FormatInfo{Format::off, "off", "a mesh in OFF", "OFF", &off_result},
    FormatInfo{Format::ply, "ply", "a mesh or cloud in PLY", "ply", &ply_result},
    FormatInfo{Format::pcd, "pcd", "a point cloud in PCD", "VERSION 0.7", &pcd_result},
    FormatInfo{Format::npz, "npz", "one array of a NumPy archive: FILE.npz or FILE.npz:NAME", "",
               &npz_result},
    FormatInfo{Format::xyz, "xyz", "a point cloud as text: x y z, then colours and others",
               "0.5 1.25 2 255 0 0", &xyz_result},
    FormatInfo{Format::pts, "pts", "the same after a line with the number of points", "1024",
               &pts_result},
    FormatInfo{Format::grid, "grid", "an image as text: one row of pixels per line; or a signal",
               "0.5 1.25 2", &grid_result},
    FormatInfo{Format::raw, "raw",
               "the numbers of an image (\x1eraw_shape\x1f) or of points (\x1eraw_points\x1f)", "",
               &raw_result},
};

}  // namespace

std::span<const FormatInfo> formats() { return kFormats; }

const FormatInfo& format_info(Format format) {
  return *std::find_if(kFormats.begin(), kFormats.end(),
                       [format](const FormatInfo& info) { return info.format == format; });
}

std::optional<Format> format_from_name(std::string_view name) {
  for (const FormatInfo& info : kFormats) {
    if (info.name == name) return info.format;
  }
  return std::nullopt;
}

}  // namespace ph
